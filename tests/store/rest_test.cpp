// Bits that flip while nothing is written: noticed, and the older good slot is used.

#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "store_bench.h"

namespace nplc::store {
namespace {

const Bytes kOldTable = table_of(10, 1);
const Bytes kNewTable = table_of(12, 2);

/// kOldTable lies in slot 0, kNewTable in slot 1.
sim::SimStorage with_both(const Shape& shape) {
    sim::SimStorage device(shape.geometry);
    EXPECT_EQ(Session(device, shape.area).write(kOldTable), Phase::done);
    EXPECT_EQ(Session(device, shape.area).write(kNewTable), Phase::done);
    return device;
}

struct Part {
    std::uint32_t begin;
    std::uint32_t end;
};

/// Header, mark and content: the bytes that count.
std::vector<Part> parts(const Shape& shape, unsigned slot, std::size_t length) {
    const Layout layout(shape.geometry, shape.area);
    return {{layout.header(slot), layout.header(slot) + static_cast<std::uint32_t>(kHeaderBytes)},
            {layout.mark(slot), layout.mark(slot) + static_cast<std::uint32_t>(kMarkBytes)},
            {layout.content(slot), layout.content(slot) + static_cast<std::uint32_t>(length)}};
}

template <class Look>
std::uint64_t flip_each(const Shape& shape, const sim::SimStorage& start, unsigned slot, std::size_t length,
                        Look look) {
    std::uint64_t cases = 0;
    for (const Part& part : parts(shape, slot, length)) {
        for (std::uint32_t address = part.begin; address < part.end; ++address) {
            for (unsigned bit = 0; bit < 8; ++bit, ++cases) {
                sim::SimStorage device(start);
                device.flip(address, bit);
                look(device);
            }
        }
    }
    return cases;
}

TEST(Rest, AFlippedBitInTheLaterSlotIsNoticedAndTheOlderTableRuns) {
    for (const Shape& shape : shapes(200)) {
        const auto cases =
            flip_each(shape, with_both(shape), 1, kNewTable.size(), [&](sim::SimStorage& device) {
                Session session(device, shape.area);
                EXPECT_EQ(session.content(), kOldTable);
                EXPECT_TRUE(session.slots.is_fallback());
                EXPECT_EQ(session.slots.state(1), SlotState::damaged);
            });
        std::cout << shape.name << ": " << cases << " flips\n";
    }
}

TEST(Rest, AFlippedBitInTheOlderSlotDoesNotMatterAndIsSeen) {
    for (const Shape& shape : shapes(200)) {
        flip_each(shape, with_both(shape), 0, kOldTable.size(), [&](sim::SimStorage& device) {
            Session session(device, shape.area);
            EXPECT_EQ(session.content(), kNewTable);
            EXPECT_EQ(session.slots.state(0), SlotState::damaged);
        });
    }
}

TEST(Rest, ADamagedSlotIsNeverTheReasonToOverwriteTheGoodOne) {
    for (const Shape& shape : shapes(200)) {
        flip_each(shape, with_both(shape), 1, kNewTable.size(), [&](sim::SimStorage& device) {
            Session session(device, shape.area);
            ASSERT_TRUE(session.slots.begin().ok());
            session.poll_while(Phase::erasing);
            EXPECT_EQ(Session(device, shape.area).content(), kOldTable);
        });
    }
}

TEST(Rest, WithBothSlotsDamagedThereIsNoTableAndItIsSaid) {
    const Shape shape = shapes(200).front();
    auto device = with_both(shape);
    for (unsigned slot = 0; slot < 2; ++slot)
        device.flip(Layout(shape.geometry, shape.area).content(slot), 3);
    Session session(device, shape.area);
    EXPECT_FALSE(session.slots.has_current());
    EXPECT_TRUE(session.slots.is_fallback());
    EXPECT_EQ(session.write(kNewTable), Phase::done);
    EXPECT_EQ(Session(device, shape.area).content(), kNewTable);
}

TEST(Rest, ALossIsSaidUntilATableIsStoredAgain) {
    const Shape shape = shapes(200).front();
    auto device = with_both(shape);
    device.flip(Layout(shape.geometry, shape.area).content(1), 3);
    Session session(device, shape.area);
    EXPECT_TRUE(session.slots.is_fallback());
    EXPECT_EQ(session.write(kNewTable), Phase::done);
    EXPECT_FALSE(session.slots.is_fallback());
}

/// As the power leaves it that fails before the note in the other slot.
sim::SimStorage without_last_note(const Shape& shape, const std::vector<Bytes>& tables, unsigned noted) {
    const Layout layout(shape.geometry, shape.area);
    auto device = device_with(shape, {tables.begin(), tables.end() - 1});
    std::optional<sim::SimStorage> cut;
    device.watch([&](const sim::StorageOperation& operation) {
        if (!operation.is_erase && operation.address == layout.superseded(noted))
            cut = device.torn(operation, {});
    });
    EXPECT_EQ(Session(device, shape.area).write(tables.back()), Phase::done);
    EXPECT_TRUE(cut);
    return *cut;
}

TEST(Rest, WithoutTheNoteADamagedSlotItselfTellsOfTheLoss) {
    const Shape shape = shapes(200).front();
    const Layout layout(shape.geometry, shape.area);
    auto only = without_last_note(shape, {kOldTable}, 1);
    EXPECT_EQ(Session(only, shape.area).content(), kOldTable);
    only.flip(layout.content(0), 3);
    const Session none(only, shape.area);
    EXPECT_FALSE(none.slots.has_current());
    EXPECT_TRUE(none.slots.is_fallback());

    auto both = without_last_note(shape, {kOldTable, kNewTable}, 0);
    EXPECT_EQ(Session(both, shape.area).content(), kNewTable);
    both.flip(layout.content(1), 3);
    Session older(both, shape.area);
    EXPECT_EQ(older.content(), kOldTable);
    EXPECT_TRUE(older.slots.is_fallback());
}

TEST(Rest, HoweverManyBitsFlipNothingButAWholeTableRuns) {
    std::mt19937 random(1);
    for (const Shape& shape : shapes(200)) {
        const auto start = with_both(shape);
        for (int round = 0; round < 2000; ++round) {
            sim::SimStorage device(start);
            for (unsigned flips = 1 + random() % 64; flips > 0; --flips)
                device.flip(static_cast<std::uint32_t>(random() % shape.geometry.size), random() % 8);
            Session session(device, shape.area);
            const auto runs = session.content();
            EXPECT_TRUE(!runs || runs == kOldTable || runs == kNewTable)
                << shape.name << ", seed 1, round " << round;
            if (runs != kNewTable) {
                EXPECT_TRUE(session.slots.is_fallback()) << shape.name << ", seed 1, round " << round;
            }
        }
    }
}

TEST(Rest, ABitThatFlipsAfterTheStartIsNoticedWhenTheTableIsLoaded) {
    const Shape shape = shapes(200).front();
    auto device = with_both(shape);
    Session session(device, shape.area);
    device.flip(Layout(shape.geometry, shape.area).content(1) + 5, 0);
    Bytes bytes(1000);
    const auto length = session.slots.load(bytes);
    ASSERT_TRUE(length.ok());
    bytes.resize(length.value());
    EXPECT_EQ(bytes, kOldTable);
    EXPECT_TRUE(session.slots.is_fallback());
}

}  // namespace
}  // namespace nplc::store
