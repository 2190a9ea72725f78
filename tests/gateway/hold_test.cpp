// What a held sequence's motor did is taken up again, or the sequence does not go on.
#include <gtest/gtest.h>

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

struct Hold : testing::Test {
    BenchBoard board;
    Settings settings{};

    /// The order in step 0, then step 1, which waits for IN5.
    static std::array<std::uint8_t, 24> table(std::uint8_t command) {
        return {0xC0, 0x00, 0x00, 0x01, command, 0x00, 0, 0, 0xC1, 0x20, 0x20, 0x02,
                0x80, 0x00, 0,    0,    0x3F,    0,    0, 0, 0,    0,    0,    0};
    }
    /// FlexMAC: the word of a register.
    static std::array<std::uint8_t, 32> table_writing(std::uint8_t reg, std::uint8_t value) {
        return {0xC0, 0x00, 0x80, reg,  value, 0x00, 0, 0, 0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0, 0,
                0xC1, 0x20, 0x20, 0x02, 0x80,  0x00, 0, 0, 0x3F, 0,    0,    0,    0,    0,    0, 0};
    }
    void start(Gateway& gateway, std::span<const std::uint8_t> bytes) {
        ASSERT_TRUE(gateway.load(bytes, board.now).ok);
        board.room = 8;
        board.run(gateway, 10ms);
        ASSERT_EQ(gateway.state().step, 1);
    }
    void hold(Gateway& gateway) {
        ASSERT_TRUE(gateway.hold().ok());
        board.run(gateway, 5ms);
        ASSERT_EQ(gateway.run_state(), RunState::held);
        board.sent.clear();
    }
    void expect_mode(Gateway& gateway, std::uint32_t mode) {
        hold(gateway);
        EXPECT_TRUE(gateway.can_go_on());
        ASSERT_TRUE(gateway.run().ok());
        board.run(gateway, 5ms);
        EXPECT_EQ(gateway.run_state(), RunState::running);
        ASSERT_EQ(board.sent.size(), mode == 0 ? 0U : 1U);
        if (mode == 0) return;
        EXPECT_EQ(board.sent[0], (motor::Order{.is_register_write = true,
                                               .reg = registers::MODE_REG,
                                               .longword = board.is_mac800,
                                               .value = mode}));
    }
    void expect_refused(Gateway& gateway) {
        hold(gateway);
        EXPECT_FALSE(gateway.can_go_on());
        const auto& held = gateway.log().slot((gateway.log().count() - 1) % EventLog::kSlots);
        EXPECT_EQ(held.event, static_cast<std::uint8_t>(Event::held));
        EXPECT_EQ(held.detail, 1);
        EXPECT_EQ(gateway.run().error(), base::Error::cannot_go_on);
        EXPECT_EQ(gateway.step_once().error(), base::Error::cannot_go_on);
        EXPECT_EQ(gateway.scan_once().error(), base::Error::cannot_go_on);
        board.run(gateway, 5ms);
        EXPECT_EQ(gateway.run_state(), RunState::held);
        EXPECT_TRUE(board.sent.empty());
        gateway.stop(board.now);
        EXPECT_TRUE(gateway.run().ok()) << "from the start";
    }
};

TEST_F(Hold, UntilTheMotorHasTakenTheStopItIsOnItsWay) {
    const auto bytes = table(kPosition);
    settings.status_output = std::uint8_t{3};
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    ASSERT_TRUE(gateway.hold().ok());
    board.is_settled = false;
    board.run(gateway, 5ms);
    EXPECT_EQ(gateway.run_state(), RunState::holding);
    EXPECT_GT(board.stops, 0);
    const base::Instant due = gateway.next_poll(board.now, base::kNever);
    EXPECT_GT(due, board.now) << "the motor's driver is to be polled, not this";
    board.is_settled = true;
    EXPECT_EQ(gateway.next_poll(board.now, base::kNever), board.now);
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.run_state(), RunState::held);
}

TEST_F(Hold, ALostPartOfTheBoardIsTheSafeStateUntilTheNextStart) {
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    gateway.withdraw(SafeReason::no_lines, board.now);
    board.run(gateway, 5ms);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
    EXPECT_EQ(gateway.safe_reason(), SafeReason::no_lines);
    EXPECT_GT(board.stops, 0);
    EXPECT_EQ(gateway.run().error(), base::Error::not_enabled);
}

TEST_F(Hold, AMoveIsTakenUpAgain) {
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_mode(gateway, 2);
    expect_mode(gateway, 2);
}

TEST_F(Hold, AMac800TakesALongword) {
    board.is_mac800 = true;
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_mode(gateway, 2);
}

TEST_F(Hold, ASpeedIsTakenUpAgain) {
    const auto bytes = table(kVelocity);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_mode(gateway, 1);
}

TEST_F(Hold, AMotorAtRestStaysAtRest) {
    const auto bytes = table(kInit);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_mode(gateway, 0);
}

TEST_F(Hold, AModeThatTheTableWrote) {
    for (const std::uint8_t mode : {std::uint8_t{1}, std::uint8_t{2}}) {
        const auto bytes = table_writing(registers::MODE_REG, mode);
        Gateway gateway(board.ports(), settings, StartCause::power_up);
        start(gateway, bytes);
        expect_mode(gateway, mode);
    }
    const auto gear = table_writing(registers::MODE_REG, 3);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, gear);
    expect_refused(gateway);
}

TEST_F(Hold, AHomeSearchIsNot) {
    const auto bytes = table(command_byte(Number::home));
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_refused(gateway);
}

TEST_F(Hold, NorIsWhatSomebodyElseToldTheMotor) {
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    gateway.forget_mode();
    expect_refused(gateway);
}

TEST_F(Hold, NorIsWhatItDidBeforeTheStart) {
    settings.on_start = OnStart::keep;
    const auto bytes = table(command_byte(Number::nop));
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_refused(gateway);
}

TEST_F(Hold, AMotorThatStoppedWithAnErrorIsNotStarted) {
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    board.err = true;
    board.run(gateway, 5ms);
    expect_mode(gateway, 0);
}

/// An error may have come and gone between two scans.
TEST_F(Hold, AfterAResetOfErrorsItIsNotKnown) {
    const std::array<std::uint8_t, 40> bytes{0xC0,
                                             0x00,
                                             0x00,
                                             0x3E,
                                             kPosition,
                                             0,
                                             0,
                                             0,
                                             0xC0,
                                             0x00,
                                             0x00,
                                             0x3E,
                                             command_byte(Number::reset_error),
                                             0,
                                             0,
                                             0,
                                             0xC0,
                                             0x00,
                                             0x00,
                                             0x01,
                                             0x80,
                                             0x00,
                                             0,
                                             0,
                                             0xC1,
                                             0x20,
                                             0x20,
                                             0x02,
                                             0x80,
                                             0x00,
                                             0,
                                             0,
                                             0x3F,
                                             0,
                                             0,
                                             0,
                                             0,
                                             0,
                                             0,
                                             0};
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_refused(gateway);
}

TEST_F(Hold, ALostLinkEndsWhatItDid) {
    const auto bytes = table(kPosition);
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    hold(gateway);
    board.link_state = motor::Link::down;
    board.run(gateway, 5ms);
    board.link_state = motor::Link::unacknowledged;
    board.run(gateway, 5ms);
    expect_mode(gateway, 0);
}

TEST_F(Hold, AVirtualMotorIsLeftAlone) {
    settings.virtual_motor = true;
    const auto bytes = table(command_byte(Number::home));
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, bytes);
    expect_mode(gateway, 0);
}

/// Orders that the motor does not take for `waits`, then a hold.
struct BusyMotor : Hold {
    void hold_while_busy(Gateway& gateway) {
        start(gateway, table(kVelocity));
        board.is_settled = false;
        board.stops = 0;
        ASSERT_TRUE(gateway.hold().ok());
    }
};

TEST_F(BusyMotor, IsStoppedAfter500msAndCannotGoOn) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    hold_while_busy(gateway);
    board.run(gateway, 499ms);
    EXPECT_EQ(board.stops, 0) << "its last orders may still be executed";
    board.run(gateway, 3ms);
    EXPECT_EQ(board.stops, 1);
    board.is_settled = true;
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.run_state(), RunState::held);
    EXPECT_FALSE(gateway.can_go_on());
    EXPECT_EQ(gateway.run().error(), base::Error::cannot_go_on);
}

TEST_F(BusyMotor, ThatTakesItsOrdersIsHeldAsEver) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    hold_while_busy(gateway);
    board.run(gateway, 490ms);
    board.is_settled = true;
    board.run(gateway, 2ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway.run_state(), RunState::held);
    EXPECT_TRUE(gateway.can_go_on());
}

// In the middle of a scan, with no room for the next order.
TEST_F(BusyMotor, InTheMiddleOfAScanIsStoppedAfter500msToo) {
    settings.longest_wait = 60'000'000us;
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    const auto velocity = table(kVelocity);  // not copied by load()
    ASSERT_TRUE(gateway.load(velocity, board.now).ok);
    board.room = 0;
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.run_state(), RunState::running);
    ASSERT_EQ(gateway.state().step, 0) << "its order waits for room";
    board.stops = 0;
    ASSERT_TRUE(gateway.hold().ok());
    board.run(gateway, 499ms);
    EXPECT_EQ(board.stops, 0);
    board.run(gateway, 5ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway.run_state(), RunState::held);
    EXPECT_FALSE(gateway.can_go_on());
}

// What the motor has not confirmed refuses a run, from held as from stopped.
TEST_F(Hold, IsNotLeftBeforeTheStopIsConfirmed) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, table(kVelocity));
    hold(gateway);
    board.stop_is_confirmed = false;
    EXPECT_TRUE(gateway.stop_unconfirmed());
    EXPECT_EQ(gateway.run().error(), base::Error::stop_unconfirmed);
    EXPECT_EQ(gateway.step_once().error(), base::Error::stop_unconfirmed);
    gateway.stop(board.now);
    EXPECT_EQ(gateway.run().error(), base::Error::stop_unconfirmed);
    board.stop_is_confirmed = true;
    EXPECT_TRUE(gateway.run().ok());
}

TEST_F(Hold, OfAVirtualMotorHasNothingToConfirm) {
    settings.virtual_motor = true;
    board.stop_is_confirmed = false;
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    start(gateway, table(kVelocity));
    EXPECT_FALSE(gateway.stop_unconfirmed());
    gateway.stop(board.now);
    EXPECT_TRUE(gateway.run().ok());
}

}  // namespace
}  // namespace nplc::gateway
