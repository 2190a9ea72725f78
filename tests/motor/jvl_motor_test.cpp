#include "motor_bench.h"

namespace nplc::motor {
namespace {

TEST_F(MotorTest, StartsWithSafeCommunicationAndANopInEachPolarity) {
    motor.hear(0x00);
    motor.hear(0x00);
    exchange({0xEB, 0xEB}, 0x00, 0x80);
    exchange({0x6B, 0x6B}, 0x80, 0x00);
    exchange({0xE0, 0xE0}, 0x00, 0x80);
    EXPECT_EQ(driver.link(), Link::starting);
    exchange({0x60, 0x60}, 0x80, 0x00);
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_TRUE(driver.orders_complete());
}

TEST_F(MotorTest, StartsFromAnyToggle) {
    motor.hear(0x80);
    motor.hear(0x80);
    exchange({0x6B, 0x6B}, 0x80, 0x00);
    exchange({0xEB, 0xEB}, 0x00, 0x80);
    exchange({0x60, 0x60}, 0x80, 0x00);
    exchange({0xE0, 0xE0}, 0x00, 0x80);
    EXPECT_EQ(driver.link(), Link::up);
}

TEST_F(MotorTest, AMotorLeftInFlexMacIsBroughtBackFirst) {
    motor.hear(0x08);
    motor.hear(0x08);
    exchange({0x7E, 0x7E, 0x7E}, 0x08, 0x80);
    come_up(0x80);
    EXPECT_EQ(driver.link(), Link::up);
}

// 001 §5.2.2: header 70h, a word read by register, three times; register 05h with its inverse. The motor
// repeats it and adds the data with inverses, low byte first.
const Bytes kReadV{0x70, 0x70, 0x70, 0x05, 0xFA};
const Bytes kReplyV{0x70, 0x70, 0x70, 0x05, 0xFA, 0x34, 0xCB, 0x12, 0xED};

TEST_F(MotorTest, ReadsARegisterBetweenOrders) {
    start();
    ASSERT_TRUE(driver.begin_access({.reg = 5}));
    EXPECT_FALSE(driver.begin_access({.reg = 6})) << "one at a time";
    EXPECT_TRUE(driver.orders_complete()) << "a scan does not wait for it";
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange(kReadV, 0x08, 0x08);
    EXPECT_EQ(driver.access_state(), AccessState::under_way);
    for (const std::uint8_t byte : kReplyV) motor.hear(byte);
    motor.hear_times(2, 0x88);
    EXPECT_EQ(driver.access_state(), AccessState::done);
    EXPECT_EQ(driver.access_value(), 0x1234U);
    EXPECT_TRUE(driver.orders_complete());
    exchange({0x7E, 0x7E, 0x7E}, 0x88, 0x00);
    EXPECT_EQ(driver.counters().accesses, 1U);
    EXPECT_EQ(driver.link(), Link::up);
}

TEST_F(MotorTest, AnAnswerMayComeAfterTheEcho) {
    start();
    ASSERT_TRUE(driver.begin_access({.reg = 5}));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange(kReadV, 0x08, 0x88);
    EXPECT_EQ(driver.access_state(), AccessState::under_way);
    for (const std::uint8_t byte : kReplyV) motor.hear(byte);
    EXPECT_EQ(driver.access_state(), AccessState::done);
    EXPECT_EQ(driver.access_value(), 0x1234U);
}

TEST_F(MotorTest, AReadWithoutAnAnswerFailsAndTheLinkStays) {
    start();
    ASSERT_TRUE(driver.begin_access({.reg = 5}));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange(kReadV, 0x08, 0x88);
    motor.hear_times(100, 0x88);
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_EQ(driver.counters().access_fails, 1U);
}

TEST_F(MotorTest, OrdersComeBeforeAWaitingAccess) {
    start();
    driver.send(command(0x40));
    ASSERT_TRUE(driver.begin_access({.reg = 5}));
    exchange({0x40, 0x40}, 0x80, 0x00);
    EXPECT_EQ(driver.access_state(), AccessState::waiting);
}

TEST_F(MotorTest, AStopDropsAWaitingAccess) {
    start();
    ASSERT_TRUE(driver.begin_access({.is_write = true, .reg = 5, .value = 1}));
    driver.stop();
    EXPECT_EQ(driver.access_state(), AccessState::failed);
}

TEST_F(MotorTest, ALostLinkFailsTheAccessAndTakesNoNewOne) {
    start();
    ASSERT_TRUE(driver.begin_access({.reg = 5}));
    for (int i = 0; i < 60; ++i) motor.silence();
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    EXPECT_FALSE(driver.begin_access({.reg = 5}));
}

TEST_F(MotorTest, RapidCommunicationIsASetting) {
    JvlMotor rapid(line, {.safe_communication = false});
    Script<JvlMotor> peer{line, rapid};
    peer.hear_times(3, 0x80);
    EXPECT_EQ(line.take(), (Bytes{0x6A, 0x6A}));
    for (const int echo : {0x00, 0x80, 0x00, 0x80}) {
        EXPECT_EQ(rapid.link(), Link::starting);
        peer.hear_times(4, static_cast<std::uint8_t>(echo));
    }
    EXPECT_EQ(line.take(), (Bytes{0xEA, 0xEA, 0x60, 0x60, 0xE0, 0xE0}));
    ASSERT_EQ(rapid.link(), Link::up);
    rapid.send(command(0x42));
    peer.hear(0x80);
    EXPECT_EQ(line.take(), (Bytes{0x42})) << "one byte";
}

// The moves of 001 §5.2.1.5 by the list of §5.2.1.4: 14h|A.. as T2 = 10101, A4 = 10011, V4 = 01011, P6 =
// 00101.
TEST_F(MotorTest, OrdersGoOutInOrderWithAlternatingToggle) {
    start();
    for (const int byte : {0x63, 0x15, 0x13, 0x0B, 0x45})
        driver.send(command(static_cast<std::uint8_t>(byte)));
    EXPECT_FALSE(driver.orders_complete());
    exchange({0x63, 0x63}, 0x80, 0x00);
    exchange({0x95, 0x95}, 0x00, 0x80);
    exchange({0x13, 0x13}, 0x80, 0x00);
    exchange({0x8B, 0x8B}, 0x00, 0x80);
    exchange({0x45, 0x45}, 0x80, 0x00);
    EXPECT_TRUE(driver.orders_complete());
}

TEST_F(MotorTest, AnOrderLeavesWithoutAPollIfTheLineIsFree) {
    start();
    driver.send(command(0x63));
    driver.begin_orders(motor.now);
    EXPECT_EQ(line.take(), (Bytes{0x63, 0x63}));
    driver.send(command(0x45));
    driver.begin_orders(motor.now);
    EXPECT_EQ(line.take(), Bytes{}) << "the motor has not taken the first";
}

TEST_F(MotorTest, TheOlderRegisterCodeIsASetting) {
    JvlMotor older(line, {.register_code = protocol::fastmac::RegisterCode::older_example});
    Script<JvlMotor> peer{line, older};
    peer.hear_times(3, 0x80);
    for (const int echo : {0x00, 0x80, 0x00, 0x80}) peer.hear_times(4, static_cast<std::uint8_t>(echo));
    ASSERT_EQ(older.link(), Link::up);
    line.take();
    older.send(command(0x45));  // position mode, P6: 5Dh in the manual's example
    peer.hear(0x80);
    EXPECT_EQ(line.take(), (Bytes{0x5D, 0x5D}));
}

TEST_F(MotorTest, InPositionOfBeforeACommandIsNotUsed) {
    start();
    motor.hear_times(4, 0x90);
    EXPECT_TRUE(driver.in_position());
    driver.send(command(0x45));
    EXPECT_FALSE(driver.orders_complete()) << "the scan waits";
    motor.hear_times(3, 0x90);  // still the old toggle, still in position
    EXPECT_FALSE(driver.orders_complete());
    motor.hear(0x00);
    EXPECT_FALSE(driver.orders_complete());
    motor.hear(0x00);
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_FALSE(driver.in_position());
}

TEST_F(MotorTest, AMoveThatDoesNotClearInPositionAtOnceReadsZeroForTwoSamplesAndOneByteMore) {
    start();
    motor.hear_times(2, 0x90);
    driver.send(command(0x71));  // 11h: P_SOLL = P_IST + P7 - FLWERR
    motor.hear_times(4, 0x90);
    motor.hear(0x10);
    motor.hear(0x10);
    ASSERT_TRUE(driver.orders_complete());
    const auto executed = motor.now;
    while (!driver.in_position() && motor.now - executed < base::Milliseconds(50)) motor.hear(0x10);
    EXPECT_TRUE(driver.in_position());
    EXPECT_GE(motor.now - executed, base::Microseconds(2 * 1920));
    EXPECT_LT(motor.now - executed, base::Microseconds(2 * 1920) + 3 * Script<JvlMotor>::kCharacter);
}

TEST_F(MotorTest, InPositionFromBeforeAMoveIsNotUsedAfterABurstOfDamage) {
    start();
    motor.hear_times(2, 0x90);
    driver.send(command(0x71));
    motor.hear_times(4, 0x90);
    motor.hear_times(2, 0x10);  // taken, but not worked out yet
    ASSERT_TRUE(driver.orders_complete());
    for (const int damaged : {0x11, 0x30, 0x14, 0x50, 0x12, 0x90, 0x18, 0x00, 0x11, 0x30, 0x14, 0x50}) {
        motor.hear(static_cast<std::uint8_t>(damaged));
        EXPECT_FALSE(driver.in_position());
    }
    motor.hear(0x00);  // two samples are over: IN_POS is 0
    EXPECT_FALSE(driver.in_position());
    motor.hear_times(4, 0x00);
    EXPECT_FALSE(driver.in_position());
}

TEST_F(MotorTest, AMotorThatRestartsInAWriteHasNotConfirmedIt) {
    start();
    driver.send(write(5, 100));
    driver.send(write(6, 100));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange({0x60, 0x60, 0x60, 0x05, 0xFA, 0x64, 0x9B, 0x00, 0xFF}, 0x08, 0x88);
    exchange({0x60, 0x60, 0x60, 0x06, 0xF9, 0x64, 0x9B, 0x00, 0xFF}, 0x88, 0x00);  // toggle 0, and FastMAC
    motor.hear_times(4, 0x00);
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.counters().orders, 1U);
    EXPECT_EQ(driver.counters().link_losses, 1U);
}

TEST_F(MotorTest, NothingWaitingIsDeliveredAfterNobodyListenedForLong) {
    start();
    driver.send(write(5, 100));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    motor.now += base::Milliseconds(1000);
    line.in_transmitter = 0;
    line.take();
    motor.hear(0x08);
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_TRUE(driver.error());
    EXPECT_TRUE(line.sent.empty());
}

TEST_F(MotorTest, WhatWaitsBehindAnAcceptedOrderIsNotDeliveredAfterAGapEither) {
    start();
    driver.send(command(0x45));
    driver.send(command(0x46));
    motor.hear_times(3, 0x80);
    EXPECT_EQ(line.take(), (Bytes{0x45, 0x45}));
    line.received.insert(line.received.end(), 4, {0x00, false});  // taken
    motor.now += base::Milliseconds(1000);
    motor.hear(0x00);
    EXPECT_TRUE(line.sent.empty());
    EXPECT_EQ(driver.link(), Link::down);
    EXPECT_TRUE(driver.error());
}

TEST_F(MotorTest, AGapBetweenPollsIsNoSilenceIfTheMotorWentOn) {
    start();
    motor.now += base::Milliseconds(60);
    for (int i = 0; i < 100; ++i) line.received.push_back({0x80, false});
    motor.hear(0x80);
    EXPECT_EQ(driver.link(), Link::up);
}

TEST_F(MotorTest, AMac800HasNoWordWrites) {
    const JvlMotor mac800(line, {.registers_are_32_bit = true});
    EXPECT_FALSE(mac800.can_execute(write(5, 100)));
    EXPECT_TRUE(mac800.can_execute({.is_register_write = true, .reg = 5, .longword = true, .value = 100}));
    EXPECT_TRUE(mac800.can_execute(command(0x45)));
    EXPECT_TRUE(driver.can_execute(write(5, 100)));
}

// P_SOLL in the register form: 60h|80h = E0h, register 3, low byte first: 230,000 = 38270h as in 002's
// example.
TEST_F(MotorTest, ARegisterWriteGoesThroughFlexMacAndBack) {
    start();
    driver.send({.is_register_write = true, .reg = 3, .longword = true, .value = 230'000});
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange({0xE0, 0xE0, 0xE0, 0x03, 0xFC, 0x70, 0x8F, 0x82, 0x7D, 0x03, 0xFC, 0x00, 0xFF}, 0x08, 0x88);
    EXPECT_FALSE(driver.orders_complete());
    exchange({0x7E, 0x7E, 0x7E}, 0x88, 0x00);
    EXPECT_TRUE(driver.orders_complete());
}

TEST_F(MotorTest, WritesInARowStayInFlexMac) {
    start();
    driver.send(write(5, 0x0547));
    driver.send(write(6, 100));
    driver.send(command(0x45));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange({0x60, 0x60, 0x60, 0x05, 0xFA, 0x47, 0xB8, 0x05, 0xFA}, 0x08, 0x88);
    exchange({0x60, 0x60, 0x60, 0x06, 0xF9, 0x64, 0x9B, 0x00, 0xFF}, 0x88, 0x08);
    exchange({0x7E, 0x7E, 0x7E}, 0x08, 0x80);
    exchange({0x45, 0x45}, 0x80, 0x00);
    EXPECT_TRUE(driver.orders_complete());
}

TEST_F(MotorTest, StopDropsTheQueueAndWritesModeRegZero) {
    start();
    driver.send(command(0x45));
    driver.send(command(0x46));
    motor.hear(0x80);
    EXPECT_EQ(line.take(), (Bytes{0x45, 0x45}));
    driver.stop();
    motor.hear_times(2, 0x80);
    motor.hear_times(2, 0x00);
    exchange({0xFF, 0xFF}, 0x00, 0x88);
    exchange({0x60, 0x60, 0x60, 0x02, 0xFD, 0x00, 0xFF, 0x00, 0xFF}, 0x88, 0x08);
    exchange({0x7E, 0x7E, 0x7E}, 0x08, 0x80);
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_EQ(driver.counters().discarded, 1U);
}

TEST_F(MotorTest, StopOfAMac800IsALongword) {
    JvlMotor mac800(line, {.registers_are_32_bit = true});
    Script<JvlMotor> peer{line, mac800};
    mac800.stop();
    peer.hear_times(3, 0x80);
    for (const int echo : {0x00, 0x80, 0x00, 0x80}) peer.hear_times(4, static_cast<std::uint8_t>(echo));
    ASSERT_EQ(mac800.link(), Link::up);
    line.take();
    peer.hear_times(4, 0x08);
    const Bytes sent = line.take();
    ASSERT_GE(sent.size(), 13U);
    EXPECT_EQ(Bytes(sent.begin(), sent.begin() + 5), (Bytes{0xE0, 0xE0, 0xE0, 0x02, 0xFD}));
}

TEST_F(MotorTest, TheMotorsOwnErrorShows) {
    start();
    motor.hear(0x81);
    EXPECT_FALSE(driver.error()) << "one byte is not valid";
    motor.hear(0x81);
    EXPECT_TRUE(driver.error());
    motor.hear_times(2, 0x80);
    EXPECT_FALSE(driver.error());
}

TEST_F(MotorTest, AFramingErrorSeenHereAsksForSlowTransmissionOnce) {
    start();
    motor.hear(0x80, true);
    exchange({0x73, 0x73}, 0x80, 0x00);
    EXPECT_TRUE(driver.orders_complete());
    motor.hear(0x00, true);
    motor.hear_times(10, 0x00);
    EXPECT_TRUE(line.sent.empty());
}

TEST_F(MotorTest, AStreamThatNeverComesInStepIsAskedToSlowDownBlindly) {
    for (int i = 0; i < 3; ++i) motor.hear(0x55, true);
    EXPECT_EQ(line.take(), (Bytes{0x73, 0x73, 0xF3, 0xF3}))
        << "13h with either toggle, twice for safe communication";
}

// A table may hold any command: the driver keeps its own idea of the link true.
TEST_F(MotorTest, UseFlexMacFromATableDoesNotLeaveTheLinkThere) {
    start();
    driver.send(command(0x7F));
    driver.send(command(0x45));
    exchange({0x7F, 0x7F}, 0x80, 0x08);
    exchange({0x7E, 0x7E, 0x7E}, 0x08, 0x80);
    exchange({0x45, 0x45}, 0x80, 0x00);
}

TEST_F(MotorTest, RapidAndSafeFromATableAreFollowed) {
    start();
    driver.send(command(0x6A));
    exchange({0x6A, 0x6A}, 0x80, 0x00);
    driver.send(command(0x45));
    exchange({0xC5}, 0x00, 0x80);
    driver.send(command(0x6B));
    exchange({0x6B}, 0x80, 0x00);
    driver.send(command(0x45));
    exchange({0xC5, 0xC5}, 0x00, 0x80);
}

TEST_F(MotorTest, MyAddrInPlaceOfAStatusByteUpsetsNothing) {
    start();
    driver.send(command(0x7D));
    exchange({0x7D, 0x7D}, 0x80, 0x00);
    motor.hear(0x17);  // MYADDR as in 001 §5.1's example
    motor.hear_times(4, 0x00);
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_FALSE(driver.error());
    EXPECT_TRUE(driver.orders_complete());
}

}  // namespace
}  // namespace nplc::motor
