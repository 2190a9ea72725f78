#include "gateway/gateway.h"

#include <gtest/gtest.h>

#include "bench_board.h"

namespace nplc::gateway {
namespace {

struct GatewayTest : testing::Test {
    BenchBoard board;

    Gateway make(const Settings& settings = {}) { return {board.ports(), settings, StartCause::power_up}; }
};

// Step 0: IN0 -> outputs 5, step 1. 001 §6.1.5, §6.1.7.
constexpr sequencer::TermBytes kIn0ToStep1{0xC0, 0x01, 0x01, 0x01, 0x80, 0x05, 0, 0};

TEST_F(GatewayTest, AnInputMovesTheStepAndTheOutputs) {
    const Bytes table{kIn0ToStep1};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.state().step, 0);
    EXPECT_EQ(board.out, 0);
    board.in = 1;
    board.run(gateway, 2ms);
    EXPECT_EQ(gateway.state().step, 0) << "not before the debounce time";
    board.run(gateway, 3ms);
    EXPECT_EQ(gateway.state().step, 1);
    EXPECT_EQ(board.out, 5);
}

// Step 0: IN0 -> 60h (NOP) to the motor, step 1. 001 §6.1.6.
constexpr sequencer::TermBytes kIn0ToNop{0xC0, 0x01, 0x01, 0x01, 0x60, 0, 0, 0};

TEST_F(GatewayTest, AnOrderLeavesAtOnceAndAnEdgeNeedsNoPollOfTheMotor) {
    const Bytes table{kIn0ToNop};
    Gateway gateway = make({.debounce = 0us});
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 10ms);
    ASSERT_EQ(board.sent.size(), 0U);
    const int polls = board.polls;
    board.in = 1;
    gateway.poll(board.now);
    EXPECT_EQ(board.sent.size(), 1U);
    EXPECT_EQ(board.begun, static_cast<std::size_t>(board.stops) + 1);
    EXPECT_EQ(board.polls, polls);
}

TEST_F(GatewayTest, AStopLeavesInThePollThatFindsItsReason) {
    const Bytes table{kIn0ToNop};
    board.in = 2;
    Gateway gateway = make({.enable_input = 1, .debounce = 0us});
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.run_state(), RunState::running);
    const int stops = board.stops;
    board.in = 0;
    gateway.poll(board.now);
    EXPECT_EQ(board.stops, stops + 1);
    EXPECT_EQ(board.begun, static_cast<std::size_t>(board.stops));
}

TEST_F(GatewayTest, InPosAndErrorAreBits6And7) {
    const Bytes table{{0xC0, 0x40, 0x40, 0x01, 0x80, 0x01, 0, 0}, {0xC1, 0x80, 0x00, 0x02, 0x80, 0x02, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 5ms);
    EXPECT_EQ(gateway.state().step, 0);
    board.in_pos = true;
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.state().step, 1);
    board.err = true;
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.state().step, 2);
}

TEST_F(GatewayTest, TheTimerRunsInMilliseconds) {
    const Bytes table{{0xC0, 0x00, 0x00, 0x01, 0x80, 0x01, 0xF4, 0x01},  // 01F4h = 500 ms
                      {0x41, 0x00, 0x00, 0x02, 0x80, 0x02, 0, 0}};       // TIMER_BIT 0: waits for 0
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    while (board.out != 1) board.run(gateway, 250us);
    const auto preset = board.out_since;
    board.run(gateway, 499ms);
    EXPECT_EQ(gateway.state().step, 1);
    board.run(gateway, 2ms);
    EXPECT_EQ(gateway.state().step, 2);
    EXPECT_EQ(board.out_since - preset, 500ms);
}

TEST_F(GatewayTest, TheTimerRunsOnWhileTheScanWaitsAndAPresetIsNotChargedForIt) {
    const Bytes table{{0xC0, 0x00, 0x00, 0x01, 0x45, 0x01, 0x64, 0x00},  // sends 45h, 100 ms
                      {0x41, 0x00, 0x00, 0x02, 0x80, 0x02, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    board.room = 0;
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 300ms);
    EXPECT_EQ(gateway.state().step, 0) << "halted by the full queue";
    board.room = 8;
    board.run(gateway, 500us);
    EXPECT_EQ(gateway.state().step, 1);
    EXPECT_GE(gateway.state().timer, 99);
    board.is_settled = false;
    board.run(gateway, 200ms);
    EXPECT_EQ(gateway.state().timer, 0);
    EXPECT_EQ(gateway.state().step, 1) << "no scan before the motor has executed the command";
    board.is_settled = true;
    board.run(gateway, 500us);
    EXPECT_EQ(gateway.state().step, 2);
}

TEST_F(GatewayTest, TheTimerSurvivesAnyGapBetweenPolls) {
    const Bytes table{{0xC0, 0x00, 0x00, 0x01, 0x80, 0x01, 0xFF, 0xFF},
                      {0x41, 0x00, 0x00, 0x02, 0x80, 0x02, 0, 0}};
    Gateway gateway = make();
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 5ms);
    ASSERT_EQ(gateway.state().step, 1);
    board.now += 100h;  // 2^32 us are 71.6 minutes
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.state().step, 2);
}

TEST_F(GatewayTest, OrdersGoOutInTableOrder) {
    const Bytes table{{0xC0, 0x01, 0x01, 0x3E, 0x0B, 0x00, 0, 0},
                      {0xC0, 0x01, 0x81, 0x83, 0x70, 0x82, 0x03, 0x00},
                      {0xC0, 0x01, 0x01, 0x01, 0x45, 0x00, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.in = 1;
    board.room = 2;
    board.run(gateway, 10ms);
    ASSERT_EQ(board.sent.size(), 2U) << "the third waits for room";
    EXPECT_EQ(gateway.state().step, 0);
    board.room = 1;
    board.run(gateway, 1ms);
    ASSERT_EQ(board.sent.size(), 3U);
    EXPECT_EQ(board.sent[0], (motor::Order{.command = 0x0B}));
    EXPECT_EQ(board.sent[1],
              (motor::Order{.is_register_write = true, .reg = 3, .longword = true, .value = 230'000}));
    EXPECT_EQ(board.sent[2], (motor::Order{.command = 0x45}));
    EXPECT_EQ(board.orders_seen, 3);
    EXPECT_EQ(gateway.state().step, 1);
}

TEST_F(GatewayTest, ScansThatCanChangeNothingAreSkipped) {
    const Bytes table{kIn0ToStep1, {0xC1, 0x00, 0x00, 0x3E, 0x80, 0x05, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 100ms);
    EXPECT_EQ(board.scans_seen.size(), 1U);
    EXPECT_GT(gateway.scans(), 300U);
    board.in = 1;
    board.run(gateway, 100ms);
    // IN0 seen; step 1 writes the same outputs: done once, nothing new. Later inputs wake it again.
    EXPECT_EQ(board.scans_seen.size(), 3U);
    board.in = 3;
    board.run(gateway, 100ms);
    EXPECT_EQ(board.scans_seen.size(), 4U);
}

TEST_F(GatewayTest, ATermThatSendsIsScannedEveryTime) {
    const Bytes table{{0xC0, 0x00, 0x00, 0x3E, 0x60, 0x00, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    board.room = 1000;
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_GE(board.sent.size(), 38U) << "every scan in which the term is true; a scan a poll";
}

TEST_F(GatewayTest, ATimerThatReachesZeroWakesASkippingSequence) {
    const Bytes table{{0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0x0A, 0x00},
                      {0x41, 0x00, 0x00, 0x02, 0x80, 0x00, 0, 0}};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 20ms);
    EXPECT_EQ(gateway.state().step, 2);
    EXPECT_LE(board.scans_seen.size(), 5U);
}

TEST_F(GatewayTest, LoadingWhileItRunsIsRefused) {
    const Bytes table{kIn0ToStep1};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 5ms);
    const auto again = gateway.load(table, board.now);
    EXPECT_FALSE(again.ok);
    EXPECT_EQ(again.fault.error, base::Error::not_stopped);
    EXPECT_EQ(gateway.run_state(), RunState::running);
}

TEST_F(GatewayTest, WithoutAutostartItWaitsForRun) {
    const Bytes table{kIn0ToStep1};
    Gateway gateway = make({.autostart = false});
    EXPECT_EQ(gateway.run().error(), base::Error::no_table);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 50ms);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
    EXPECT_TRUE(gateway.run().ok());
    board.run(gateway, 5ms);
    EXPECT_EQ(gateway.run_state(), RunState::running);
    EXPECT_EQ(gateway.run().error(), base::Error::not_stopped);
}

TEST_F(GatewayTest, RunAfterStopBeginsAtStepZero) {
    const Bytes table{kIn0ToStep1};
    Gateway gateway = make();
    gateway.observe(&board);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.in = 1;
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.state().step, 1);
    gateway.stop(board.now);
    board.in = 0;
    board.run(gateway, 10ms);
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.state(), sequencer::State{});
}

}  // namespace
}  // namespace nplc::gateway
