// Power fails at every operation of a change of set-points or recipes, and at every pair of operations of two
// changes, in every way that tears_of names: the old or the new set is there afterwards, never a mixture.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "sim/sim_storage.h"
#include "store/set_points.h"

namespace nplc::store {
namespace {

struct StoreShape {
    const char* name;
    ports::StorageGeometry geometry;
    Area area;
};

/// What the boards have: a file as flash pages, an EEPROM that is written by bytes.
const StoreShape kShapes[] = {
    {"flash 2048/8",
     {.size = 8192, .erase_block = 2048, .program_page = 256, .program_unit = 8},
     {2048, 2048}},
    {"flash 1024/4", {.size = 8192, .erase_block = 1024, .program_page = 1024, .program_unit = 4}, {0, 2048}},
    {"EEPROM 64/64", {.size = 8192, .erase_block = 64, .program_page = 64, .program_unit = 64}, {0, 2048}},
};

/// The values of one set, all made from `seed`.
void fill(SetPointImage& image, std::uint8_t seed) {
    image.clear();
    for (std::uint32_t i = 0; i < 16; ++i)
        image.wanted().add(
            {.name_hash = i + 1, .value = seed * 1000 + static_cast<std::int32_t>(i), .unit = seed});
    for (std::size_t recipe = 1; recipe <= 2; ++recipe) {
        image.recipe(recipe)[0] = static_cast<std::uint8_t>('A' + seed);
        image.values_of(recipe).copy_from(image.wanted());
    }
    image.set_active(seed % 3);
}

std::vector<std::uint8_t> bytes_of(std::uint8_t seed) {
    SetPointImage image;
    fill(image, seed);
    return {image.bytes().begin(), image.bytes().end()};
}

bool save(sim::SimStorage& device, const StoreShape& shape, std::uint8_t seed) {
    SetPointStore store(device, shape.area);
    EXPECT_TRUE(store.mount());
    fill(store.image(), seed);
    EXPECT_TRUE(store.save());
    for (int i = 0; i < 100'000 && store.is_saving(); ++i) store.poll();
    return store.phase() == Phase::done;
}

sim::SimStorage device_with(const StoreShape& shape, std::initializer_list<std::uint8_t> seeds) {
    sim::SimStorage device(shape.geometry);
    for (const std::uint8_t seed : seeds) EXPECT_TRUE(save(device, shape, seed)) << shape.name;
    return device;
}

template <class AtCut>
void cut_everywhere(const sim::SimStorage& start, const StoreShape& shape, std::uint8_t next, AtCut at_cut) {
    sim::SimStorage device(start);
    device.watch([&](const sim::StorageOperation& operation) {
        for (const sim::Tear& tear : sim::tears_of(operation, shape.geometry))
            at_cut(device.torn(operation, tear));
    });
    ASSERT_TRUE(save(device, shape, next)) << shape.name;
}

/// Which of the two it is.
std::uint8_t expect_old_or_new(sim::SimStorage& device, const StoreShape& shape, std::uint8_t old,
                               std::uint8_t next) {
    SetPointStore store(device, shape.area);
    EXPECT_TRUE(store.mount()) << shape.name;
    const std::vector<std::uint8_t> found(store.image().bytes().begin(), store.image().bytes().end());
    const bool is_new = found == bytes_of(next);
    EXPECT_TRUE(is_new || found == bytes_of(old)) << shape.name;
    return is_new ? next : old;
}

TEST(SetPointPowerCut, OnceInAChangeTheOldOrTheNewSetIsThere) {
    for (const StoreShape& shape : kShapes) {
        std::size_t cases = 0;
        std::size_t news = 0;
        cut_everywhere(device_with(shape, {1, 2}), shape, 3, [&](sim::SimStorage device) {
            ++cases;
            news += expect_old_or_new(device, shape, 2, 3) == 3 ? 1U : 0U;
            if (cases % 64 != 0) return;
            EXPECT_TRUE(save(device, shape, 4));
            EXPECT_EQ(expect_old_or_new(device, shape, 4, 4), 4);
        });
        EXPECT_GT(news, 0U);
        EXPECT_GT(cases, news);
        std::cout << shape.name << ": " << cases << " cases, new set " << news << '\n';
    }
}

/// In the quick run some of the first cuts; all of them with NPLC_EVERY_PAIR (`ctest -L long`).
TEST(SetPointPowerCut, TwiceInTwoChangesNoSetIsLostAndNoneIsMixed) {
    const std::size_t every = std::getenv("NPLC_EVERY_PAIR") != nullptr ? 1 : 97;
    for (const StoreShape& shape : kShapes) {
        std::size_t first = 0;
        std::size_t pairs = 0;
        cut_everywhere(device_with(shape, {1, 2}), shape, 3, [&](sim::SimStorage device) {
            if (++first % every != 0) return;
            const std::uint8_t then = expect_old_or_new(device, shape, 2, 3);
            cut_everywhere(device, shape, 4, [&](sim::SimStorage again) {
                ++pairs;
                expect_old_or_new(again, shape, then, 4);
            });
        });
        std::cout << shape.name << ": " << pairs << " pairs\n";
    }
}

/// Every bit that changes at rest: the other set or none, and it is said.
TEST(SetPointPowerCut, AFlippedBitIsNoticed) {
    const StoreShape& shape = kShapes[0];
    sim::SimStorage device = device_with(shape, {1, 2});
    for (std::uint32_t bit = 0; bit < 8 * 2 * shape.area.slot_bytes; ++bit) {
        const std::uint32_t at = bit / 8;
        device.flip(shape.area.begin + at, bit % 8);
        SetPointStore store(device, shape.area);
        const bool mounted = store.mount().ok();
        const std::vector<std::uint8_t> found(store.image().bytes().begin(), store.image().bytes().end());
        EXPECT_TRUE(found == bytes_of(2) || found == bytes_of(1)) << at;
        EXPECT_TRUE(!mounted || found == bytes_of(2)) << at << ": an older set must be said to be one";
        device.flip(shape.area.begin + at, bit % 8);
    }
}

}  // namespace
}  // namespace nplc::store
