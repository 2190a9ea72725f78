// A line to the motor that falls silent, and comes back.

#include "motor_bench.h"

namespace nplc::motor {
namespace {

struct LostLink : MotorTest {
    void lose() {
        start();
        motor.hear_times(2, 0x90);
        for (int i = 0; i < 45; ++i) motor.silence();
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
    EXPECT_TRUE(driver.settled()) << "the sequence runs on and sees the error";
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

TEST_F(LostLink, AStopOrderedMeanwhileIsTheFirstThingDelivered) {
    lose();
    driver.stop();
    restart();
    exchange({0xFF, 0xFF}, 0x10, 0x98);
    exchange({0x60, 0x60, 0x60, 0x02, 0xFD, 0x00, 0xFF, 0x00, 0xFF}, 0x98, 0x18);
}

TEST_F(MotorTest, AnUnconfirmedWriteIsALostLink) {
    start();
    driver.send(write(5, 100));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    motor.hear_times(300, 0x08);
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.counters().link_losses, 1U);
}

}  // namespace
}  // namespace nplc::motor
