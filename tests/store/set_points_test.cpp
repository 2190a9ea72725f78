#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "base/bytes.h"
#include "store/set_points.h"
#include "store_bench.h"

namespace nplc::store {
namespace {

using registers::set_points::Entry;
using registers::set_points::kEntryBytes;
using registers::set_points::kMost;

struct SetPointImageTest : testing::Test {
    SetPointImage image;

    void name(std::size_t recipe, std::string_view text) {
        std::copy(text.begin(), text.end(), image.recipe(recipe).begin());
    }
    std::uint8_t named(std::string_view text) {
        std::array<std::uint8_t, kRecipeNameBytes + 1> bytes{};
        std::copy(text.begin(), text.end(), bytes.begin());
        return image.recipe_named(bytes.data());
    }
};

/// As SET_POINTS.md has an entry, of what is looked at here.
struct EntryBytes {
    std::array<std::uint8_t, kEntryBytes> bytes{};
    EntryBytes(std::uint32_t hash, std::uint8_t unit, std::int32_t lowest, std::int32_t highest) {
        bytes[3] = unit;
        base::store_u32(&bytes[8], static_cast<std::uint32_t>(lowest));
        base::store_u32(&bytes[12], static_cast<std::uint32_t>(highest));
        base::store_u32(&bytes[16], hash);
    }
    Entry entry() const { return Entry(bytes.data()); }
};

/// firmware/gateway/SET_POINTS.md, "What is stored".
TEST_F(SetPointImageTest, InBytes) {
    image.wanted().add({.name_hash = 0x04030201, .value = -2, .unit = 7});
    image.wanted().add({.name_hash = 0x14131211, .value = 0x01020304, .unit = 8});
    image.set_active(2);
    name(1, "Small");
    image.values_of(1).add({.name_hash = 0x24232221, .value = 1, .unit = 9});
    const auto bytes = image.bytes();
    const std::array<std::uint8_t, 26> head{1,    kRecipes, 2,    0,    0,    0,    0,    0,        //
                                            0x01, 0x02,     0x03, 0x04, 0xFE, 0xFF, 0xFF, 0xFF, 7,  //
                                            0x11, 0x12,     0x13, 0x14, 0x04, 0x03, 0x02, 0x01, 8};
    EXPECT_TRUE(std::equal(head.begin(), head.end(), bytes.begin()));
    // 8 bytes and 16 values of 9 before the recipes, each of 16 bytes and 16 values.
    const std::array<std::uint8_t, 25> recipe{'S', 'm', 'a', 'l',  'l',  0,    0,    0, 0, 0, 0, 0, 0,
                                              0,   0,   0,   0x21, 0x22, 0x23, 0x24, 1, 0, 0, 0, 9};
    EXPECT_TRUE(std::equal(recipe.begin(), recipe.end(), bytes.begin() + 152));
    EXPECT_EQ(image.recipe(2).data() - bytes.data(), 152 + 160);
    EXPECT_EQ(bytes.size(), 152 + 160 * kRecipes);
}

TEST_F(SetPointImageTest, IsEmptyAtFirstAndWhenCleared) {
    EXPECT_TRUE(image.is_sound());
    EXPECT_TRUE(image.wanted().is_empty());
    EXPECT_EQ(image.active(), 0);
    EXPECT_FALSE(image.has_recipe(1));
    image.wanted().add({.name_hash = 1, .value = 2, .unit = 3});
    name(kRecipes, "x");
    image.set_active(1);
    EXPECT_FALSE(image.wanted().is_empty());
    EXPECT_TRUE(image.has_recipe(kRecipes));
    image.clear();
    EXPECT_TRUE(std::ranges::equal(image.bytes(), SetPointImage().bytes()));
}

TEST_F(SetPointImageTest, OfAnotherFirmwareIsNotSound) {
    for (const std::size_t at : {0U, 1U, 2U}) {
        image.clear();
        image.bytes()[at] = 99;
        EXPECT_FALSE(image.is_sound()) << at;
    }
    image.clear();
    image.set_active(kRecipes);
    EXPECT_TRUE(image.is_sound());
    image.set_active(kRecipes + 1);
    EXPECT_FALSE(image.is_sound());
}

TEST_F(SetPointImageTest, ARecipeIsFoundByItsNameInAnyCase) {
    name(1, "Az@[`{9");
    name(2, "0123456789abcdef");
    image.values_of(2).add({.name_hash = 0xFFFF'FFFF, .value = 1, .unit = 1});
    name(3, "Az");
    EXPECT_EQ(named("aZ@[`{9"), 1);
    EXPECT_EQ(named("az`[`{9"), 0);
    EXPECT_EQ(named("az@{`{9"), 0);
    EXPECT_EQ(named("0123456789ABCDEF"), 2);
    EXPECT_EQ(named("0123456789ABCDEG"), 0);
    EXPECT_EQ(named("AZ"), 3);
    EXPECT_EQ(named("A"), 0);
    EXPECT_EQ(named("AZ@"), 0);
    EXPECT_EQ(named(std::string_view("AZ\0what follows", 16)), 3);
    EXPECT_EQ(named(""), 4) << "the first that is free";
    for (std::size_t recipe = 4; recipe <= kRecipes; ++recipe)
        name(recipe, recipe == kRecipes ? "last" : "x");
    EXPECT_EQ(named("last"), kRecipes);
    EXPECT_EQ(named(""), 0);
}

TEST_F(SetPointImageTest, AValueTakesItsOwnPlaceAgain) {
    ValueSet values = image.wanted();
    values.add({.name_hash = 1, .value = 10, .unit = 5});
    values.add({.name_hash = 2, .value = 20, .unit = 5});
    values.add({.name_hash = 1, .value = 11, .unit = 6});
    std::int32_t value = 0;
    EXPECT_TRUE(values.find(EntryBytes(1, 6, 0, 100).entry(), value));
    EXPECT_EQ(value, 11);
    EXPECT_TRUE(values.find(EntryBytes(2, 5, 0, 100).entry(), value));
    EXPECT_EQ(value, 20);
    EXPECT_FALSE(values.find(EntryBytes(1, 5, 0, 100).entry(), value));
    EXPECT_FALSE(values.find(EntryBytes(3, 5, 0, 100).entry(), value));
}

TEST_F(SetPointImageTest, AValueCountsOnlyWithinItsRange) {
    image.wanted().add({.name_hash = 1, .value = -10, .unit = 5});
    std::int32_t value = 77;
    EXPECT_TRUE(image.wanted().find(EntryBytes(1, 5, -10, -10).entry(), value));
    EXPECT_EQ(value, -10);
    value = 77;
    EXPECT_FALSE(image.wanted().find(EntryBytes(1, 5, -9, 100).entry(), value));
    EXPECT_FALSE(image.wanted().find(EntryBytes(1, 5, -100, -11).entry(), value));
    EXPECT_EQ(value, 77);
}

TEST_F(SetPointImageTest, SixteenValuesAndNoMore) {
    for (std::uint32_t i = 1; i <= kMost + 1; ++i)
        image.wanted().add({.name_hash = i, .value = static_cast<std::int32_t>(i), .unit = 5});
    std::int32_t value = 0;
    EXPECT_TRUE(image.wanted().find(EntryBytes(kMost, 5, 0, 100).entry(), value));
    EXPECT_EQ(value, static_cast<std::int32_t>(kMost));
    EXPECT_FALSE(image.wanted().find(EntryBytes(kMost + 1, 5, 0, 100).entry(), value));
    EXPECT_FALSE(image.has_recipe(1)) << "what lies behind is untouched";
    name(1, "AAAAAAAAA");
    EXPECT_FALSE(image.wanted().find(EntryBytes(0x41414141, 0x41, 0, INT32_MAX).entry(), value));
    image.values_of(1).copy_from(image.wanted());
    EXPECT_TRUE(image.values_of(1).find(EntryBytes(kMost, 5, 0, 100).entry(), value));
    EXPECT_FALSE(image.has_recipe(2));
    image.values_of(1).clear();
    EXPECT_TRUE(image.values_of(1).is_empty());
    EXPECT_FALSE(image.values_of(1).find(EntryBytes(kMost, 5, 0, 100).entry(), value));
    EXPECT_FALSE(image.wanted().is_empty());
}

struct SetPointStoreTest : testing::Test {
    static constexpr Area kArea{0, 2048};
    static constexpr base::Instant kNow{base::Microseconds{5}};
    sim::SimStorage device{{.size = 8192, .erase_block = 1024, .program_page = 1024, .program_unit = 4}};

    static void poll_to_end(SetPointStore& store) {
        for (int i = 0; i < 100'000 && store.is_saving(); ++i) store.poll();
    }
    void store_bytes(std::span<const std::uint8_t> bytes) {
        write_raw(device, kArea, Kind::set_points, Bytes(bytes.begin(), bytes.end()));
    }
};

TEST_F(SetPointStoreTest, SavesInPhasesAndSleepsWhenItIsDone) {
    SetPointStore store(device, kArea);
    ASSERT_TRUE(store.mount());
    EXPECT_FALSE(store.is_saving());
    EXPECT_EQ(store.next_poll(kNow), base::kNever);
    store.image().set_active(1);
    ASSERT_TRUE(store.save());
    bool was_receiving = false;
    for (int i = 0; i < 100'000 && store.is_saving(); ++i) {
        if (store.phase() == Phase::receiving) {
            was_receiving = true;
            EXPECT_EQ(store.next_poll(kNow), kNow);
        }
        store.poll();
    }
    EXPECT_TRUE(was_receiving);
    EXPECT_EQ(store.phase(), Phase::done);
    EXPECT_EQ(SetPointStore(device, kArea).mount().ok(), true);
}

TEST_F(SetPointStoreTest, WhatWasChangedAndNotSavedIsDropped) {
    SetPointStore store(device, kArea);
    ASSERT_TRUE(store.mount());
    store.image().set_active(1);
    ASSERT_TRUE(store.drop_changes());
    EXPECT_EQ(store.image().active(), 0);
    store.image().set_active(1);
    ASSERT_TRUE(store.save());
    poll_to_end(store);
    store.image().set_active(2);
    ASSERT_TRUE(store.drop_changes());
    EXPECT_EQ(store.image().active(), 1);
}

TEST_F(SetPointStoreTest, ContentOfAnotherSizeOrFirmwareIsDamagedAndNoneStandsIn) {
    SetPointImage image;
    image.set_active(1);
    image.bytes()[0] = 2;
    store_bytes(image.bytes());
    SetPointStore other(device, kArea);
    EXPECT_EQ(other.mount().error(), base::Error::damaged);
    EXPECT_TRUE(std::ranges::equal(other.image().bytes(), SetPointImage().bytes()));
    image.bytes()[0] = 1;
    store_bytes(image.bytes().first(SetPointImage::kBytes - 4));
    SetPointStore shorter(device, kArea);
    EXPECT_EQ(shorter.mount().error(), base::Error::damaged);
    EXPECT_EQ(shorter.image().active(), 0);
    store_bytes(image.bytes());
    SetPointStore good(device, kArea);
    EXPECT_TRUE(good.mount());
    EXPECT_EQ(good.image().active(), 1);
}

TEST_F(SetPointStoreTest, AnOlderSetThatStandsInIsSaid) {
    SetPointStore store(device, kArea);
    ASSERT_TRUE(store.mount());
    for (const unsigned active : {1U, 2U}) {
        store.image().set_active(static_cast<std::uint8_t>(active));
        ASSERT_TRUE(store.save());
        poll_to_end(store);
    }
    device.flip(kArea.slot_bytes + 40, 0);  // in the second slot's content
    SetPointStore again(device, kArea);
    EXPECT_EQ(again.mount().error(), base::Error::damaged);
    EXPECT_EQ(again.image().active(), 1);
}

}  // namespace
}  // namespace nplc::store
