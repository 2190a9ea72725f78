#include "motor/jvl_link.h"

#include <gtest/gtest.h>

#include "scripted_line.h"

namespace nplc::motor {
namespace {

using Result = JvlLink::Result;

// Status bytes (001 §5.2.1.6): bit 7 toggle, 6 dec, 5 acc, 4 in position, 3 FlexMAC, 2 framing error, 0
// error.
struct LinkTest : testing::Test {
    ScriptedLine line;
    JvlLink link{line, {}};
    Script<JvlLink> motor{line, link};

    void in_step(std::uint8_t status) {
        motor.hear(status);
        motor.hear(status);
        ASSERT_TRUE(link.known());
        link.synchronize();
    }
    /// By two NOPs that are echoed at once.
    void measure_echo() {
        for (const int toggle : {0x80, 0x00}) {
            link.send_command(0x60, 1, motor.now);
            motor.hear(static_cast<std::uint8_t>(toggle ^ 0x80));
            motor.hear_times(2, static_cast<std::uint8_t>(toggle));
        }
        ASSERT_FALSE(link.busy());
        line.take();
    }
    void measure_flexmac_echo() {
        for (const int shown : {0x88, 0x08}) {
            link.send_command(0x7F, 1, motor.now);
            motor.hear(static_cast<std::uint8_t>(shown ^ 0x80));
            motor.hear_times(2, static_cast<std::uint8_t>(shown));
        }
        ASSERT_FALSE(link.busy());
        line.take();
    }
    /// Receives `byte` up to `times` times; how many it took until something was sent or decided.
    int hear_until_sent(std::uint8_t byte, int times) {
        for (int i = 1; i <= times; ++i) {
            if (motor.hear(byte) != Result::none || !line.sent.empty()) return i;
        }
        return 0;
    }
};

TEST_F(LinkTest, OneStatusByteIsNotBelieved) {
    motor.hear(0x10);
    EXPECT_FALSE(link.known());
    motor.hear(0x90);
    EXPECT_FALSE(link.known());
    motor.hear(0x90);
    EXPECT_TRUE(link.known());
    EXPECT_TRUE(link.status().toggle);
    EXPECT_TRUE(link.status().in_position);
}

TEST_F(LinkTest, AFramingErrorBreaksThePair) {
    motor.hear(0x10);
    motor.hear(0x10, true);
    EXPECT_FALSE(link.known());
    EXPECT_TRUE(link.framing_error_seen());
    motor.hear(0x10);
    EXPECT_FALSE(link.known());
}

TEST_F(LinkTest, ACommandCarriesTheOtherToggle) {
    in_step(0x00);
    link.send_command(0x62, 1, motor.now);  // 001 §5.2.1.4: P_SOLL = 0
    motor.hear(0x00);
    EXPECT_EQ(line.take(), (Bytes{0xE2}));
    EXPECT_EQ(motor.hear(0x80), Result::none);
    EXPECT_EQ(motor.hear(0x80), Result::accepted);
    EXPECT_FALSE(link.busy());
    link.send_command(0x62, 2, motor.now);
    motor.hear(0x80);
    EXPECT_EQ(line.take(), (Bytes{0x62, 0x62}));
}

TEST_F(LinkTest, NothingIsSentAgainWithoutProof) {
    in_step(0x00);
    link.send_command(0x60, 1, motor.now);
    motor.hear(0x00);
    line.take();
    // The echo is damaged, then different every time: no proof either way.
    for (const int byte : {0x80, 0x00, 0x90, 0x00, 0x84, 0x00, 0x80, 0x00}) {
        EXPECT_EQ(motor.hear(static_cast<std::uint8_t>(byte)), Result::none);
        EXPECT_TRUE(line.sent.empty());
    }
}

TEST_F(LinkTest, AFastCommandIsSentAgainWithTheSameToggleThreeTimesAtMost) {
    in_step(0x00);
    measure_echo();
    link.send_command(0x60, 1, motor.now);
    motor.hear(0x00);
    EXPECT_EQ(line.take(), Bytes{0xE0});
    for (int resend = 1; resend <= 3; ++resend) {
        EXPECT_GE(hear_until_sent(0x00, 40), 2) << "at least two status bytes after the whole command";
        EXPECT_EQ(line.take(), Bytes{0xE0});
    }
    Result result = Result::none;
    for (int i = 0; i < 140 && result == Result::none; ++i) result = motor.hear(0x00);
    EXPECT_EQ(result, Result::refused);
    EXPECT_TRUE(line.sent.empty());
}

TEST_F(LinkTest, BytesHeardBeforeTheLastOneHasLeftProveNothing) {
    in_step(0x08);
    link.send_flexmac({.target = 3, .value = 0x0547}, motor.now);  // 7 bytes
    motor.hear_times(7, 0x08);
    EXPECT_EQ(line.take(), (Bytes{0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}));
    EXPECT_EQ(motor.hear(0x88), Result::none);
    EXPECT_EQ(motor.hear(0x88), Result::accepted);
    EXPECT_TRUE(line.sent.empty());
}

TEST_F(LinkTest, AFlexMessageIsSentAgainWholeOnceNoLateEchoCanCome) {
    in_step(0x08);
    measure_flexmac_echo();
    link.send_flexmac({.target = 3, .value = 0x0547}, motor.now);
    motor.hear_times(8, 0x08);
    line.take();
    const auto finished = motor.now;
    hear_until_sent(0x08, 200);
    const base::Microseconds proof = JvlLink::Settings{}.proof_time;
    EXPECT_GE(motor.now - finished, proof);
    EXPECT_LT(motor.now - finished, proof + base::Milliseconds(5))
        << "the echo, and three bytes that show the old toggle";
    EXPECT_EQ(line.take(), (Bytes{0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}));
}

TEST_F(LinkTest, ALateEchoOfAFlexMessageIsWaitedFor) {
    in_step(0x08);
    link.send_flexmac({.target = 3, .value = 0x0547}, motor.now);
    motor.hear_times(8, 0x08);
    line.take();
    motor.hear_times(20, 0x08);  // 10 ms of status bytes from before
    motor.hear(0x88);
    EXPECT_EQ(motor.hear(0x88), Result::accepted);
    EXPECT_TRUE(line.sent.empty());
}

TEST_F(LinkTest, FlexMacIsEnteredOnlyWhenBit3Shows) {
    in_step(0x00);
    link.send_command(0x7F, 2, motor.now);
    motor.hear_times(2, 0x00);
    EXPECT_EQ(line.take(), (Bytes{0xFF, 0xFF}));
    motor.hear(0x80);
    EXPECT_EQ(motor.hear(0x80), Result::none) << "toggle echoed, but still FastMAC";
    motor.hear(0x88);
    EXPECT_EQ(motor.hear(0x88), Result::accepted);
    EXPECT_TRUE(link.flexmac());
}

TEST_F(LinkTest, LeavingFlexMacIs7EThreeTimesAndReadsTheToggleAnew) {
    in_step(0x08);
    link.leave_flexmac(motor.now);
    motor.hear_times(3, 0x08);
    EXPECT_EQ(line.take(), (Bytes{0x7E, 0x7E, 0x7E}));
    motor.hear(0x80);
    EXPECT_EQ(motor.hear(0x80), Result::accepted);
    EXPECT_FALSE(link.flexmac());
    EXPECT_TRUE(link.toggle());
}

TEST_F(LinkTest, LeavingFlexMacIsRepeatedWhileBit3Stays) {
    in_step(0x08);
    measure_flexmac_echo();
    link.leave_flexmac(motor.now);
    motor.hear_times(3, 0x08);
    line.take();
    hear_until_sent(0x08, 200);
    EXPECT_EQ(line.take(), (Bytes{0x7E, 0x7E, 0x7E})) << "7Fh is never tried instead";
}

TEST_F(LinkTest, AnotherToggleBeforeFlexMacIsLeftDeniesTheEchoBefore) {
    in_step(0x08);
    link.leave_flexmac(motor.now);
    EXPECT_EQ(motor.hear(0x88), Result::none) << "one byte has no redundancy";
    EXPECT_EQ(motor.hear(0x88), Result::out_of_step);
}

TEST_F(LinkTest, TwentyMillisecondsWithoutStatusIsSilence) {
    in_step(0x00);
    measure_echo();
    const auto last = motor.now;
    Result result = Result::none;
    while (result == Result::none && motor.now - last < base::Milliseconds(100)) result = motor.silence();
    EXPECT_EQ(result, Result::silent);
    EXPECT_GT(motor.now - last, base::Milliseconds(20));
    EXPECT_LT(motor.now - last, base::Milliseconds(22));
}

TEST_F(LinkTest, BytesWithFramingErrorsAreNoSignOfLife) {
    in_step(0x00);
    measure_echo();
    Result result = Result::none;
    for (int i = 0; i < 50 && result == Result::none; ++i) result = motor.hear(0x00, true);
    EXPECT_EQ(result, Result::silent);
}

TEST_F(LinkTest, AToggleNobodySentIsOutOfStepOnceItStays) {
    in_step(0x00);
    EXPECT_EQ(motor.hear(0x80), Result::none);
    EXPECT_EQ(motor.hear(0x80), Result::none);
    EXPECT_EQ(motor.hear(0x00), Result::none);
    Result result = Result::none;
    for (int i = 0; i < 6 && result == Result::none; ++i) result = motor.hear(0x80);
    EXPECT_EQ(result, Result::out_of_step);
}

TEST_F(LinkTest, FlexMacThatEndsByItselfIsOutOfStep) {
    in_step(0x08);
    link.send_flexmac({.target = 3, .value = 1}, motor.now);
    Result result = Result::none;
    for (int i = 0; i < 12 && result == Result::none; ++i) result = motor.hear(0x00);
    EXPECT_EQ(result, Result::out_of_step) << "its bytes would be FastMAC commands to a motor that was reset";
}

TEST_F(LinkTest, EveryMessageEndsWithinItsTime) {
    in_step(0x00);
    link.send_command(0x60, 1, motor.now);
    const auto started = motor.now;
    Result result = Result::none;
    std::uint8_t byte = 0;
    while (result == Result::none && motor.now - started < base::Milliseconds(1000)) {
        result = motor.hear(byte ^= 0x90);  // never two equal, never proof
    }
    EXPECT_EQ(result, Result::refused);
    EXPECT_LT(motor.now - started, base::Milliseconds(260));
}

TEST_F(LinkTest, PausesBetweenItsBytesWhileTheMotorReportsFramingErrors) {
    in_step(0x0C);
    link.send_flexmac({.target = 3, .value = 0x0547}, motor.now);
    std::vector<int> sent_at;
    EXPECT_EQ(line.take(), Bytes{0x63});
    sent_at.push_back(-1);
    for (int i = 0; i < 14; ++i) {
        motor.hear(0x0C);
        for (std::size_t n = line.take().size(); n != 0; --n) sent_at.push_back(i);
    }
    ASSERT_EQ(sent_at.size(), 7U);
    for (std::size_t i = 1; i < sent_at.size(); ++i) EXPECT_EQ(sent_at[i] - sent_at[i - 1], 2);
}

}  // namespace
}  // namespace nplc::motor
