// Frames that are valid and never change prove nothing: a wire stuck low is a stream of 00h.

#include <algorithm>

#include "motor_bench.h"

namespace nplc::motor {
namespace {

/// At 19200 baud a status byte is 521 us: 38 of them are 19.8 ms, 39 are 20.3 ms.
constexpr int kWithinSilence = 38;
/// 150 ms: 20 ms to the NOP, 60 ms that its last repeat may be late, and the repeats before.
constexpr int kLostWithin = 288;

struct ProvedLink : MotorTest {
    void expect_nop(const Bytes& bytes, std::uint8_t before, std::uint8_t after) {
        motor.hear_times(kWithinSilence - 4, before);
        EXPECT_TRUE(line.sent.empty()) << "not before 20 ms";
        exchange(bytes, before, after);
    }
    /// It may read the line again meanwhile, and finds it unchanged.
    void expect_lost() {
        EXPECT_FALSE(link_is_usable(driver.link()));
        EXPECT_TRUE(driver.error());
        EXPECT_FALSE(driver.in_position());
        EXPECT_EQ(driver.counters().link_losses, 1U);
    }
};

TEST_F(ProvedLink, AnIdleMotorIsAskedForItsToggleEachTimeOfSilence) {
    start();
    for (int i = 0; i < 10; ++i) {
        expect_nop({0x60, 0x60}, 0x80, 0x00);
        expect_nop({0xE0, 0xE0}, 0x00, 0x80);
    }
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_EQ(driver.counters().resent, 0U);
}

/// A line without a pace of its own, such as a pseudo-terminal, may bring the echo before the line's rate
/// allows it.
TEST_F(ProvedLink, AnEchoBeforeTheMessageCanHaveLeftBringsNoFlood) {
    start();
    std::uint8_t shown = 0x80;
    std::size_t sent = 0;
    constexpr int kCharactersIn200Ms = 384;
    for (int i = 0; i < kCharactersIn200Ms; ++i) {
        if (!line.sent.empty()) shown = static_cast<std::uint8_t>(line.sent.back() & 0x80);
        sent += line.take().size();
        motor.hear(shown);
    }
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_GE(sent, 2U * 8);
    EXPECT_LE(sent, 2U * 10) << "a NOP, sent twice, each 20 ms";
}

TEST_F(ProvedLink, AWireStuckLowIsALostLink) {
    motor.hear_times(2, 0x00);
    come_up(0x00);
    ASSERT_EQ(driver.link(), Link::up);
    motor.hear_times(kLostWithin, 0x00);
    expect_lost();
}

TEST_F(ProvedLink, AWireStuckWhileInPositionIsALostLink) {
    start();
    motor.hear_times(2, 0x90);
    motor.hear_times(kLostWithin, 0x90);
    expect_lost();
}

TEST_F(ProvedLink, OrdersProveItToo) {
    start();
    std::uint8_t shown = 0x80;
    for (int i = 0; i < 20; ++i) {
        const auto other = static_cast<std::uint8_t>(shown ^ 0x80);
        const auto byte = static_cast<std::uint8_t>(0x41 | other);
        motor.hear_times(30, shown);
        driver.send(command(0x41));
        exchange({byte, byte}, shown, other);
        shown = other;
    }
}

TEST_F(ProvedLink, InPositionStaysWhileItIsAsked) {
    start();
    motor.hear_times(2, 0x90);
    ASSERT_TRUE(driver.in_position());
    for (int i = 0; i < 40 && line.sent.empty(); ++i) motor.hear(0x90);
    EXPECT_EQ(line.take(), (Bytes{0x60, 0x60}));
    EXPECT_TRUE(driver.in_position());
    EXPECT_TRUE(driver.orders_complete()) << "a scan does not wait for it";
    motor.hear_times(3, 0x10);
    EXPECT_TRUE(driver.in_position());
}

TEST_F(ProvedLink, AnOrderWaitsAtMostForItsEcho) {
    start();
    for (int i = 0; i < 40 && line.sent.empty(); ++i) motor.hear(0x80);
    ASSERT_EQ(line.take(), (Bytes{0x60, 0x60}));
    driver.send(command(0x41));
    EXPECT_FALSE(driver.orders_complete());
    motor.hear_times(2, 0x80);
    EXPECT_TRUE(line.sent.empty());
    exchange({0xC1, 0xC1}, 0x00, 0x80);
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_EQ(driver.counters().orders, 1U) << "the NOP is no order";
}

TEST_F(ProvedLink, AStopDoesNotWaitForAMotorThatDoesNotAnswer) {
    start();
    for (int i = 0; i < 40 && line.sent.empty(); ++i) motor.hear(0x80);
    line.take();
    driver.stop();
    motor.hear_times(kLostWithin, 0x80);
    expect_lost();
    const Bytes blind{0x7F, 0x7F, 0xFF, 0xFF};
    EXPECT_NE(std::search(line.sent.begin(), line.sent.end(), blind.begin(), blind.end()), line.sent.end());
    EXPECT_FALSE(driver.stop_confirmed());
}

// A damaged byte of rapid communication is another command: once a second is enough.
TEST_F(ProvedLink, WithRapidCommunicationOnceASecond) {
    JvlMotor rapid(line, {.safe_communication = false});
    Script<JvlMotor> peer{line, rapid};
    for (const int echo : {0x80, 0x00, 0x80, 0x00, 0x80}) peer.hear_times(4, static_cast<std::uint8_t>(echo));
    ASSERT_EQ(rapid.link(), Link::up);
    line.take();
    peer.hear_times(1900, 0x80);  // 990 ms, less the last echo
    EXPECT_TRUE(line.sent.empty());
    for (int i = 0; i < 40 && line.sent.empty(); ++i) peer.hear(0x80);
    EXPECT_EQ(line.take(), (Bytes{0x60}));
    peer.hear_times(3, 0x00);
    EXPECT_EQ(rapid.link(), Link::up);
}

TEST_F(ProvedLink, TheNextPollIsNotLaterThanTheQuestion) {
    start();
    EXPECT_LE(driver.next_poll(motor.now), motor.now + base::Milliseconds(20) + base::Microseconds(1));
}

}  // namespace
}  // namespace nplc::motor
