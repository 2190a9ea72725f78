// A line to the motor that falls silent, and comes back.

#include "motor_bench.h"

namespace nplc::motor {
namespace {

struct LostLink : MotorTest {
    void lose() {
        start();
        motor.hear_times(2, 0x90);
        for (int i = 0; i < 45; ++i) motor.silence();
        line.take();  // the NOP that was not answered
    }
    void restart() {
        motor.hear_times(2, 0x10);
        come_up(0x10);
    }
    /// Forgets what was sent, and lets the motor come back.
    void expect_nothing_late() {
        line.take();
        line.in_transmitter = 0;
        restart();
        motor.hear_times(10, 0x10);
        EXPECT_TRUE(line.sent.empty());
    }
};

TEST_F(LostLink, ReadsErrorAndNotInPosition) {
    lose();
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_TRUE(driver.error());
    EXPECT_FALSE(driver.in_position());
    EXPECT_TRUE(driver.orders_complete()) << "the sequence runs on and sees the error";
}

TEST_F(LostLink, TheLongestSilenceIsASetting) {
    JvlMotor patient(line, {.link = {.silence = base::Milliseconds(100)}, .safe_communication = false});
    Script<JvlMotor> peer{line, patient};
    for (const int echo : {0x80, 0x00, 0x80, 0x00, 0x80}) peer.hear_times(4, static_cast<std::uint8_t>(echo));
    ASSERT_EQ(patient.link(), Link::up);
    for (int i = 0; i < 190; ++i) peer.silence();  // 99.0 ms
    EXPECT_EQ(patient.link(), Link::up);
    for (int i = 0; i < 3; ++i) peer.silence();  // 100.6 ms
    EXPECT_EQ(patient.link(), Link::down);
    EXPECT_TRUE(patient.error());
}

TEST_F(LostLink, DiscardsEveryOrderAndDeliversNoneLate) {
    lose();
    driver.send(command(0x45));
    driver.send(command(0x61));
    restart();
    motor.hear_times(10, 0x10);
    EXPECT_TRUE(line.sent.empty());
    EXPECT_EQ(driver.counters().discarded, 2U);
}

TEST_F(LostLink, OrdersThatWaitedWhenItWasLostAreGone) {
    start();
    driver.send(command(0x45));
    driver.send(command(0x46));
    for (int i = 0; i < 45; ++i) motor.silence();
    expect_nothing_late();
    EXPECT_EQ(driver.counters().discarded, 2U);
}

TEST_F(LostLink, APersonsWriteThatWaitedWhenItWasLostIsGone) {
    start();
    driver.send(command(0x45));
    ASSERT_TRUE(driver.begin_access({.is_write = true, .reg = 5, .value = 1}));
    for (int i = 0; i < 45; ++i) motor.silence();
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    expect_nothing_late();
}

TEST_F(LostLink, APersonsWriteUnderWayWhenItWasLostIsNotFinishedLater) {
    start();
    ASSERT_TRUE(driver.begin_access({.is_write = true, .reg = 5, .value = 1}));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    for (int i = 0; i < 20 && line.sent.size() < 5; ++i) motor.hear(0x08);
    EXPECT_EQ(driver.access_state(), AccessState::under_way);
    for (int i = 0; i < 60; ++i) motor.silence();
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    expect_nothing_late();
}

TEST_F(LostLink, ErrorStaysUntilResetErrorIsExecuted) {
    lose();
    restart();
    EXPECT_EQ(driver.link(), Link::unacknowledged);
    motor.hear_times(10, 0x10);
    EXPECT_TRUE(driver.error());
    EXPECT_FALSE(driver.in_position());
    driver.send(command(0x61));
    exchange({0xE1, 0xE1}, 0x10, 0x90);
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_TRUE(driver.in_position());
}

// Blind: 7Fh 7Fh FFh FFh, MODE_REG := 0 twice, 7Eh three times (001 §5.2.2: 60h, register 2, word 0).
TEST_F(LostLink, AStopOrderedMeanwhileIsSentBlindAndIsTheFirstThingDelivered) {
    lose();
    EXPECT_TRUE(driver.stop_confirmed()) << "none was ordered";
    driver.stop();
    for (int i = 0; i < 45; ++i) motor.silence();
    EXPECT_EQ(line.take(), (Bytes{0x7F, 0x7F, 0xFF, 0xFF,                                //
                                  0x60, 0x60, 0x60, 0x02, 0xFD, 0x00, 0xFF, 0x00, 0xFF,  //
                                  0x60, 0x60, 0x60, 0x02, 0xFD, 0x00, 0xFF, 0x00, 0xFF,  //
                                  0x7E, 0x7E, 0x7E}));
    EXPECT_FALSE(driver.stop_confirmed());
    restart();
    EXPECT_FALSE(driver.stop_confirmed()) << "the link is up; the stop was not taken yet";
    exchange({0xFF, 0xFF}, 0x10, 0x98);
    exchange({0x60, 0x60, 0x60, 0x02, 0xFD, 0x00, 0xFF, 0x00, 0xFF}, 0x98, 0x18);
    EXPECT_FALSE(driver.stop_confirmed()) << "two damaged status bytes look the same";
    exchange({0x7E, 0x7E, 0x7E}, 0x18, 0x90);
    EXPECT_TRUE(driver.stop_confirmed());
}

// At a start, too, the driver waits for an answer first.
TEST(Start, NothingIsSentBlindBeforeTheLinkCountsAsLost) {
    ScriptedLine line;
    JvlMotor driver{line, {}};
    Script<JvlMotor> motor{line, driver};
    driver.stop();
    for (int i = 0; i < 38; ++i) motor.silence();  // 19.8 ms
    EXPECT_TRUE(line.take().empty());
    for (int i = 0; i < 5; ++i) motor.silence();  // 22.4 ms
    EXPECT_FALSE(line.take().empty());
}

// A motor in step that does not take the stop: nothing is sent blind while the link counts as up.
TEST_F(MotorTest, NothingIsSentBlindWhileTheLinkIsUp) {
    start();
    driver.stop();
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    for (int i = 0; i < 100; ++i) {
        motor.hear(0x08);
        if (driver.link() == Link::up) continue;
        break;
    }
    for (const std::uint8_t byte : line.take()) EXPECT_NE(byte, 0x7F);
    EXPECT_FALSE(driver.stop_confirmed());
}

TEST_F(MotorTest, AnUnconfirmedWriteIsALostLink) {
    start();
    driver.send(write(5, 100));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    motor.hear_times(500, 0x08);
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.counters().link_losses, 1U);
}

}  // namespace
}  // namespace nplc::motor
