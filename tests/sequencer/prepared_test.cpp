#include "sequencer/prepared.h"

#include <gtest/gtest.h>

#include <vector>

#include "tables.h"

namespace nplc::sequencer {
namespace {

struct Room {
    Room(std::size_t actions_, std::size_t orders_)
        : cells(PreparedTable::kCells), actions(actions_), orders(orders_) {}
    PreparedTable::Storage storage() { return {cells, actions, orders}; }

    std::vector<std::uint16_t> cells;
    std::vector<PreparedTable::Action> actions;
    std::vector<MotorOrder> orders;
};

Table load(const Bytes& bytes) {
    return Table::load(bytes).table;
}

// IN0: command 11h; IN1: command 12h and step 1; both: 11h, 12h.
const Bytes kTwoTerms = table_of({{0xC0, 1, 1, 0x3E, 0x11, 1, 0, 0}, {0xC0, 2, 2, 0x01, 0x12, 2, 0, 0}});

TEST(Prepared, RunsLikeTheTable) {
    Room room(16, 16);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(kTwoTerms), room.storage()).ok());
    PreparedEngine engine(prepared);
    std::vector<std::uint8_t> sent;
    const auto sink = [&](const MotorOrder& order) { sent.push_back(order.command); };

    EXPECT_FALSE(engine.scan(0, sink).any());
    EXPECT_TRUE(engine.scan(1, sink).sent);
    EXPECT_EQ(engine.state(), (State{0, 1, 0, 0}));
    EXPECT_TRUE(engine.scan(3, sink).changed);
    EXPECT_EQ(engine.state(), (State{1, 2, 0, 0}));
    EXPECT_EQ(sent, (std::vector<std::uint8_t>{0x11, 0x11, 0x12}));
    EXPECT_FALSE(engine.scan(3, sink).any());
    engine.reset();
    EXPECT_EQ(engine.state(), State{});
}

TEST(Prepared, TimerIsCountedDown) {
    const Bytes bytes = table_of({{0xC0, 0, 0, 0x01, 0x80, 0, 0x0A, 0}, {0x41, 0, 0, 0x02, 0x80, 0, 0, 0}});
    Room room(16, 16);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(bytes), room.storage()).ok());
    PreparedEngine engine(prepared);
    const auto nobody = [](const MotorOrder&) {};
    EXPECT_TRUE(engine.scan(0, nobody).timer_preset);
    engine.elapse(9);
    engine.scan(0, nobody);
    EXPECT_EQ(engine.state().step, 1);
    engine.elapse(1);
    engine.scan(0, nobody);
    EXPECT_EQ(engine.state().step, 2);
}

TEST(Prepared, TableWithoutOrdersNeedsNoRoomForThem) {
    const Bytes bytes = table_of({{0xC0, 1, 1, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x00, 0x80, 1, 0, 0}});
    Room room(16, 0);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(bytes), room.storage()).ok());
    PreparedEngine engine(prepared);
    engine.scan(1, [](const MotorOrder&) {});
    EXPECT_EQ(engine.state().step, 1);
}

TEST(Prepared, EmptyTableNeedsOneAction) {
    const Bytes bytes = table_of({});
    Room room(1, 0);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(bytes), room.storage()).ok());
    PreparedEngine engine(prepared);
    engine.restore({.step = 62});
    EXPECT_FALSE(engine.scan(0xFF, [](const MotorOrder&) {}).any());
}

// Outcomes: nothing, {11h}, {12h}, {11h, 12h}: 4 actions and 1 + 1 + 2 = 4 orders.
TEST(Prepared, TellsHowMuchItUses) {
    Room room(16, 16);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(kTwoTerms), room.storage()).ok());
    EXPECT_EQ(prepared.actions_used(), 4U);
    EXPECT_EQ(prepared.orders_used(), 4U);
}

TEST(Prepared, ExactRoomIsEnough) {
    Room room(4, 4);
    PreparedTable prepared;
    EXPECT_TRUE(prepared.prepare(load(kTwoTerms), room.storage()).ok());
}

TEST(Prepared, OneCellActionOrOrderTooFewIsNoSpace) {
    PreparedTable prepared;
    Room few_actions(3, 4);
    EXPECT_EQ(prepared.prepare(load(kTwoTerms), few_actions.storage()).error(), base::Error::no_space);
    Room few_orders(4, 3);
    EXPECT_EQ(prepared.prepare(load(kTwoTerms), few_orders.storage()).error(), base::Error::no_space);
    Room few_cells(4, 4);
    few_cells.cells.pop_back();
    EXPECT_EQ(prepared.prepare(load(kTwoTerms), few_cells.storage()).error(), base::Error::no_space);
    Room no_actions(0, 0);
    EXPECT_EQ(prepared.prepare(load(table_of({})), no_actions.storage()).error(), base::Error::no_space);
}

// 1,023 terms of one step that are all true at ERROR off; the outcome is one list of 1,023 orders.
TEST(Prepared, ManyOrdersInOneScan) {
    Bytes bytes;
    for (int i = 0; i < 1023; ++i) {
        const TermBytes term{
            0xC0, 0, 0x80, 0x05, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 0, 0};
        bytes.insert(bytes.end(), term.begin(), term.end());
    }
    bytes.insert(bytes.end(), kEndTerm.begin(), kEndTerm.end());
    Room room(2, 1023);
    PreparedTable prepared;
    ASSERT_TRUE(prepared.prepare(load(bytes), room.storage()).ok());
    PreparedEngine engine(prepared);
    std::uint32_t next = 0;
    engine.scan(0, [&](const MotorOrder& order) { EXPECT_EQ(order.value, next++); });
    EXPECT_EQ(next, 1023U);
    EXPECT_FALSE(engine.scan(0x80, [](const MotorOrder&) {}).sent);
}

}  // namespace
}  // namespace nplc::sequencer
