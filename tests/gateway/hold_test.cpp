// What a held sequence's motor did is taken up again, or the sequence does not go on.
#include <gtest/gtest.h>

#include <optional>

#include "bench_board.h"
#include "protocol/fastmac.h"
#include "registers/mac.h"

namespace nplc::gateway {
namespace {

using protocol::fastmac::command_byte;
using protocol::fastmac::Number;

constexpr std::uint8_t kVelocity = 0x28;  // 001 §5.2.1.4: velocity mode, V1
constexpr std::uint8_t kPosition = 0x41;  // position mode, P2
constexpr std::uint8_t kInit = 0x08;      // init mode, V1

constexpr sequencer::TermBytes kToStep1{0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0, 0};
constexpr sequencer::TermBytes kStep1WaitsForIn5{0xC1, 0x20, 0x20, 0x02, 0x80, 0x00, 0, 0};

/// The order in step 0, then step 1.
Bytes ordering(std::uint8_t command) {
    return {{0xC0, 0x00, 0x00, 0x01, command, 0x00, 0, 0}, kStep1WaitsForIn5};
}
Bytes ordering(Number number) {
    return ordering(command_byte(number));
}
Bytes writing_mode(std::uint8_t mode) {
    return {{0xC0, 0x00, 0x80, registers::MODE_REG, mode, 0x00, 0, 0}, kToStep1, kStep1WaitsForIn5};
}

struct Hold : testing::Test {
    BenchBoard board;
    Settings settings{};
    Bytes table{};  // not copied by load()
    std::optional<Gateway> gateway;

    void load(const Bytes& bytes) {
        table = bytes;
        gateway.emplace(board.ports(), settings, StartCause::power_up);
        ASSERT_TRUE(gateway->load(table, board.now).ok);
    }
    void start(const Bytes& bytes) {
        load(bytes);
        run(10ms);
        ASSERT_EQ(gateway->state().step, 1);
    }
    void run(base::Microseconds duration) { board.run(*gateway, duration); }
    void hold() {
        ASSERT_TRUE(gateway->hold().ok());
        run(5ms);
        ASSERT_EQ(gateway->run_state(), RunState::held);
        board.sent.clear();
    }
    void expect_mode(std::uint32_t mode) {
        hold();
        EXPECT_TRUE(gateway->can_go_on());
        ASSERT_TRUE(gateway->run().ok());
        run(5ms);
        EXPECT_EQ(gateway->run_state(), RunState::running);
        ASSERT_EQ(board.sent.size(), mode == 0 ? 0U : 1U);
        if (mode == 0) return;
        EXPECT_EQ(board.sent[0], (motor::Order{.is_register_write = true,
                                               .reg = registers::MODE_REG,
                                               .longword = board.is_mac800,
                                               .value = mode}));
    }
    void expect_refused() {
        hold();
        EXPECT_FALSE(gateway->can_go_on());
        const auto& held = gateway->log().slot((gateway->log().count() - 1) % EventLog::kSlots);
        EXPECT_EQ(held.event, static_cast<std::uint8_t>(Event::held));
        EXPECT_EQ(held.detail, 1);
        EXPECT_EQ(gateway->run().error(), base::Error::cannot_go_on);
        EXPECT_EQ(gateway->step_once().error(), base::Error::cannot_go_on);
        EXPECT_EQ(gateway->scan_once().error(), base::Error::cannot_go_on);
        run(5ms);
        EXPECT_EQ(gateway->run_state(), RunState::held);
        EXPECT_TRUE(board.sent.empty());
        gateway->stop(board.now);
        EXPECT_TRUE(gateway->run().ok()) << "from the start";
    }
};

constexpr int kRefused = -1;

struct Case {
    const char* name;
    Bytes table;
    int mode;  ///< that is written on going on; 0: none
    Settings settings{};
    bool is_mac800 = false;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

// An error may have come and gone between two scans, so after RESET_ERROR what it does is not known.
const Case kCases[] = {
    {"AMoveIsTakenUpAgain", ordering(kPosition), 2},
    {"AMac800TakesALongword", ordering(kPosition), 2, {}, true},
    {"ASpeedIsTakenUpAgain", ordering(kVelocity), 1},
    {"AMotorAtRestStaysAtRest", ordering(kInit), 0},
    {"AVelocityModeThatTheTableWrote", writing_mode(1), 1},
    {"APositionModeThatTheTableWrote", writing_mode(2), 2},
    {"AGearModeIsNotTakenUp", writing_mode(3), kRefused},
    {"AHomeSearchIsNot", ordering(Number::home), kRefused},
    {"NorIsWhatItDidBeforeTheStart", ordering(Number::nop), kRefused, {.on_start = OnStart::keep}},
    {"NorIsWhatItDidBeforeAResetOfErrors",
     {{0xC0, 0x00, 0x00, 0x3E, kPosition, 0, 0, 0},
      {0xC0, 0x00, 0x00, 0x3E, command_byte(Number::reset_error), 0, 0, 0},
      kToStep1,
      kStep1WaitsForIn5},
     kRefused},
    {"AVirtualMotorIsLeftAlone", ordering(Number::home), 0, {.virtual_motor = true}},
};

struct Held : Hold, testing::WithParamInterface<Case> {};

TEST_P(Held, GoesOn) {
    settings = GetParam().settings;
    board.is_mac800 = GetParam().is_mac800;
    start(GetParam().table);
    if (GetParam().mode == kRefused) {
        expect_refused();
        return;
    }
    expect_mode(static_cast<std::uint32_t>(GetParam().mode));
    expect_mode(static_cast<std::uint32_t>(GetParam().mode));
}

INSTANTIATE_TEST_SUITE_P(Motor, Held, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_F(Hold, UntilTheMotorHasTakenTheStopItIsOnItsWay) {
    settings.status_output = std::uint8_t{3};
    start(ordering(kPosition));
    ASSERT_TRUE(gateway->hold().ok());
    board.is_settled = false;
    run(5ms);
    EXPECT_EQ(gateway->run_state(), RunState::holding);
    EXPECT_GT(board.stops, 0);
    const base::Instant due = gateway->next_poll(board.now, base::kNever);
    EXPECT_GT(due, board.now) << "the motor's driver is to be polled, not this";
    board.is_settled = true;
    EXPECT_EQ(gateway->next_poll(board.now, base::kNever), board.now);
    run(1ms);
    EXPECT_EQ(gateway->run_state(), RunState::held);
}

TEST_F(Hold, ALostPartOfTheBoardIsTheSafeStateUntilTheNextStart) {
    start(ordering(kPosition));
    gateway->lock_and_enter_safe_state(SafeReason::no_lines, board.now);
    run(5ms);
    EXPECT_EQ(gateway->run_state(), RunState::stopped);
    EXPECT_EQ(gateway->safe_reason(), SafeReason::no_lines);
    EXPECT_GT(board.stops, 0);
    EXPECT_EQ(gateway->run().error(), base::Error::not_enabled);
}

TEST_F(Hold, WhatSomebodyElseToldTheMotorIsNotTakenUp) {
    start(ordering(kPosition));
    gateway->forget_mode();
    expect_refused();
}

TEST_F(Hold, AMotorThatStoppedWithAnErrorIsNotStarted) {
    start(ordering(kPosition));
    board.err = true;
    run(5ms);
    expect_mode(0);
}

TEST_F(Hold, ALostLinkEndsWhatItDid) {
    start(ordering(kPosition));
    hold();
    board.link_state = motor::Link::down;
    run(5ms);
    board.link_state = motor::Link::unacknowledged;
    run(5ms);
    expect_mode(0);
}

/// Orders that the motor does not take for `waits`, then a hold.
struct BusyMotor : Hold {
    void hold_while_busy() {
        start(ordering(kVelocity));
        board.is_settled = false;
        board.stops = 0;
        ASSERT_TRUE(gateway->hold().ok());
    }
};

TEST_F(BusyMotor, IsStoppedAfter500msAndCannotGoOn) {
    hold_while_busy();
    run(499ms);
    EXPECT_EQ(board.stops, 0) << "its last orders may still be executed";
    run(3ms);
    EXPECT_EQ(board.stops, 1);
    board.is_settled = true;
    run(1ms);
    EXPECT_EQ(gateway->run_state(), RunState::held);
    EXPECT_FALSE(gateway->can_go_on());
    EXPECT_EQ(gateway->run().error(), base::Error::cannot_go_on);
}

TEST_F(BusyMotor, ThatTakesItsOrdersIsHeldAsEver) {
    hold_while_busy();
    run(490ms);
    board.is_settled = true;
    run(2ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway->run_state(), RunState::held);
    EXPECT_TRUE(gateway->can_go_on());
}

// In the middle of a scan, with no room for the next order.
TEST_F(BusyMotor, InTheMiddleOfAScanIsStoppedAfter500msToo) {
    settings.longest_wait = 60'000'000us;
    load(ordering(kVelocity));
    board.room = 0;
    run(10ms);
    ASSERT_EQ(gateway->run_state(), RunState::running);
    ASSERT_EQ(gateway->state().step, 0) << "its order waits for room";
    board.stops = 0;
    ASSERT_TRUE(gateway->hold().ok());
    run(499ms);
    EXPECT_EQ(board.stops, 0);
    run(5ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway->run_state(), RunState::held);
    EXPECT_FALSE(gateway->can_go_on());
}

// What the motor has not confirmed refuses a run, from held as from stopped.
TEST_F(Hold, IsNotLeftBeforeTheStopIsConfirmed) {
    start(ordering(kVelocity));
    hold();
    board.stop_is_confirmed = false;
    EXPECT_TRUE(gateway->stop_unconfirmed());
    EXPECT_EQ(gateway->run().error(), base::Error::stop_unconfirmed);
    EXPECT_EQ(gateway->step_once().error(), base::Error::stop_unconfirmed);
    gateway->stop(board.now);
    EXPECT_EQ(gateway->run().error(), base::Error::stop_unconfirmed);
    board.stop_is_confirmed = true;
    EXPECT_TRUE(gateway->run().ok());
}

TEST_F(Hold, OfAVirtualMotorHasNothingToConfirm) {
    settings.virtual_motor = true;
    board.stop_is_confirmed = false;
    start(ordering(kVelocity));
    EXPECT_FALSE(gateway->stop_unconfirmed());
    gateway->stop(board.now);
    EXPECT_TRUE(gateway->run().ok());
}

}  // namespace
}  // namespace nplc::gateway
