// A line that brings what the motor sends late: by a constant time, or held back and then together.

#include <deque>

#include "motor_bench.h"

namespace nplc::motor {
namespace {

using namespace std::chrono_literals;
using Result = JvlLink::Result;

constexpr base::Microseconds kCharacter{521};

/// A motor that takes FastMAC commands, or FlexMAC messages of 7 bytes, on a line that is `late` characters
/// late.
struct LateLine : testing::Test {
    ScriptedLine line;
    JvlLink link{line, {}};
    base::Instant now{1s};
    std::deque<std::uint8_t> under_way;
    std::size_t late = 0;
    bool toggle = false;
    bool flexmac = false;
    unsigned taken = 0;  ///< bytes

    Result step() {
        now += kCharacter;
        if (!line.sent.empty()) {
            take(line.sent.front());
            line.sent.erase(line.sent.begin());
            --line.in_transmitter;
        }
        under_way.push_back(static_cast<std::uint8_t>((toggle ? 0x80 : 0) | (flexmac ? 0x08 : 0)));
        for (; under_way.size() > late; under_way.pop_front())
            line.received.push_back({under_way.front(), false});
        return link.poll(now);
    }
    void take(std::uint8_t byte) {
        ++taken;
        if (!flexmac)
            toggle = (byte & 0x80) != 0;
        else if (taken % 7 == 0)
            toggle = !toggle;
    }
    void in_step() {
        for (std::size_t i = 0; i < late + 3; ++i) static_cast<void>((step(), 0));
        ASSERT_TRUE(link.known());
        link.synchronize();
    }
    Result command() {
        link.send_command(0x60, 1, now);
        return end();
    }
    Result end() {
        for (int i = 0; i < 600; ++i)
            if (const Result result = step(); result != Result::none) return result;
        return Result::none;
    }
};

TEST_F(LateLine, TheEchoTimeFollowsAConstantDelay) {
    for (const std::size_t characters : {0U, 8U, 20U, 31U, 60U, 75U}) {
        SCOPED_TRACE(characters);
        link.forget(now);
        late = characters;
        in_step();
        for (int i = 0; i < 5; ++i) EXPECT_EQ(command(), Result::accepted);
        EXPECT_GE(link.echo_time(), static_cast<int>(late) * kCharacter);
        EXPECT_LE(link.echo_time(), static_cast<int>(late + 3) * kCharacter);
    }
    EXPECT_EQ(link.resent(), 0U);
}

TEST_F(LateLine, TheEchoOfARepeatedMessageIsNotMeasured) {
    in_step();
    EXPECT_EQ(command(), Result::accepted);
    const auto before = link.echo_time();
    late = 40;  // 21 ms; the line stands still for so long, then goes on
    for (std::size_t i = 0; i < late; ++i) under_way.push_back(0x80);
    EXPECT_EQ(command(), Result::accepted);
    EXPECT_GT(link.resent(), 0U);
    EXPECT_EQ(link.echo_time(), before);
}

TEST_F(LateLine, ALineThatBecomesLaterIsFollowedWithoutALoss) {
    in_step();
    EXPECT_EQ(command(), Result::accepted);
    late = 70;  // 36 ms
    for (std::size_t i = 0; i < late; ++i) under_way.push_back(0x80);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(command(), Result::accepted);
    const auto resent = link.resent();
    for (int i = 0; i < 8; ++i) EXPECT_EQ(command(), Result::accepted);
    EXPECT_EQ(link.resent(), resent) << "it is known by now";
    EXPECT_GE(link.echo_time(), 70 * kCharacter);
}

TEST(EchoTime, ShrinksSlowly) {
    EchoTime echo;
    echo.learn(20ms);
    echo.learn(0ms);
    EXPECT_GT(echo.measured(), 18ms);
    echo.learn(25ms);
    EXPECT_EQ(echo.measured(), 25ms);
    for (int i = 0; i < 100; ++i) echo.learn(0ms);
    EXPECT_LT(echo.measured(), 1ms);
}

TEST(EchoTime, IsTakenForLongUntilItIsMeasured) {
    EchoTime echo;
    EXPECT_EQ(echo.at_most(), 40ms);
    EXPECT_GE(echo.patience(), 40ms);
    echo.learn(3ms);
    EXPECT_EQ(echo.at_most(), 3ms);
    EXPECT_EQ(echo.patience(), 3ms);
    echo.doubt();
    EXPECT_GT(echo.patience(), 6ms) << "until an echo is measured again";
    echo.learn(3ms);
    EXPECT_EQ(echo.patience(), 3ms);
}

TEST_F(LateLine, MoreThanFortyMillisecondsIsALostLink) {
    for (const std::size_t characters : {85U, 110U, 150U}) {  // 44, 57 and 78 ms
        SCOPED_TRACE(characters);
        link.forget(now);
        late = characters;
        in_step();
        EXPECT_EQ(command(), Result::refused);
        EXPECT_TRUE(link.was_too_late());
    }
}

TEST_F(LateLine, ALineThatBecomesLaterThanFortyMillisecondsIsLost) {
    in_step();
    EXPECT_EQ(command(), Result::accepted);
    late = 90;  // 47 ms
    for (std::size_t i = 0; i < late; ++i) under_way.push_back(0x80);
    Result result = Result::accepted;
    for (int i = 0; i < 8 && result == Result::accepted; ++i) result = command();
    EXPECT_EQ(result, Result::refused);
    EXPECT_GT(link.echo_time(), 40ms);
    link.forget(now);
    EXPECT_TRUE(link.was_too_late()) << "told after the loss too";
    late = 0;
    under_way.clear();
    in_step();
    EXPECT_EQ(command(), Result::accepted);
    EXPECT_FALSE(link.was_too_late());
}

TEST_F(LateLine, AFlexMessageIsSentOnceHoweverLateUpToFortyMilliseconds) {
    flexmac = true;
    in_step();
    for (const std::size_t characters : {0U, 20U, 74U}) {
        SCOPED_TRACE(characters);
        const std::uint8_t status = toggle ? 0x88 : 0x08;
        for (std::size_t i = late; i < characters; ++i) under_way.push_back(status);
        late = characters;
        taken = 0;
        link.send_flexmac({.target = 3, .value = 0x0547}, now);
        EXPECT_EQ(end(), Result::accepted);
        EXPECT_EQ(taken, 7U);
    }
}

TEST_F(LateLine, ACutIsNoticedLaterByTheDelay) {
    late = 30;
    in_step();
    EXPECT_EQ(command(), Result::accepted);
    const auto last = now;
    Result result = Result::none;
    while (result == Result::none && now - last < 100ms) result = link.poll(now += kCharacter);
    EXPECT_EQ(result, Result::silent);
    EXPECT_GT(now - last, 20ms + 26 * kCharacter);
    EXPECT_LT(now - last, 20ms + 33 * kCharacter);
}

/// Those that arrive together after 16 ms were sent right behind the echo.
TEST_F(MotorTest, InPositionFromBeforeAMoveIsNotUsedWhenTheLineHeldItBack) {
    start();
    motor.hear_times(2, 0x90);
    driver.send(command(0x71));
    motor.hear_times(4, 0x90);
    motor.hear_times(2, 0x10);
    ASSERT_TRUE(driver.orders_complete());
    for (int i = 0; i < 31; ++i) motor.silence();
    for (int i = 0; i < 7; ++i) {
        line.received.push_back({0x10, false});
        EXPECT_FALSE(driver.in_position());
    }
    motor.hear(0x00);
    EXPECT_FALSE(driver.in_position());
    motor.hear_times(20, 0x00);
    EXPECT_FALSE(driver.in_position());
    motor.hear_times(2, 0x10);
    EXPECT_TRUE(driver.in_position());
}

}  // namespace
}  // namespace nplc::motor
