#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
using protocol::fastmac::Number;

TEST(FastMacLink, RepeatsItsStatusWithoutPause) {
    MotorBench b;
    b.pause(10);
    EXPECT_EQ(b.sent, std::vector<std::uint8_t>(10, 0x00));
}

TEST(FastMacLink, StatusShowsTheFlags) {
    MotorBench b;
    b.command(Number::nop);
    EXPECT_EQ(b.status(), 0x80);
    b.set(ERR_STAT, 0x10);
    EXPECT_EQ(b.motor.transmit(b.at()), 0x90);
    b.set(ERR_STAT, 0x20);
    EXPECT_EQ(b.motor.transmit(b.at()), 0xA0);
    b.set(ERR_STAT, 0x40);
    EXPECT_EQ(b.motor.transmit(b.at()), 0xC0);
    b.set(ERR_STAT, 0x60);  // 001 §5.2.2: never both
    EXPECT_EQ(b.motor.transmit(b.at()), 0x80);
    for (const int bit : {0, 1, 2, 3}) {
        b.set(ERR_STAT, 1 << bit);
        EXPECT_EQ(b.motor.transmit(b.at()), 0x81);
    }
    b.set(ERR_STAT, 0x7F80);  // what a sequence cannot see
    EXPECT_EQ(b.motor.transmit(b.at()), 0x80);
}

TEST(FastMacLink, TakesACommandOnlyWithANewToggle) {
    MotorBench b;
    b.set(P1, 5);
    b.set(ERR_STAT, 1 << 9);  // relative by P_SOLL
    b.send({0x00});           // the toggle of power-up
    EXPECT_EQ(b.reg(P_SOLL), 0);
    b.send({0x80, 0x80, 0x80});
    EXPECT_EQ(b.reg(P_SOLL), 5);
    b.send({0x00});
    EXPECT_EQ(b.reg(P_SOLL), 10);
    EXPECT_EQ(b.motor.orders().size(), 2U);
}

// 0Bh: two equal bytes in a row; 0Ah: one.
TEST(FastMacLink, SafeCommunication) {
    MotorBench b;
    b.set(P1, 5);
    b.set(P1 + 2, 6);
    b.send({0xEB});
    EXPECT_TRUE(b.motor.link().safe_communication());
    b.send({0x00, 0x01});  // a pair that is none
    EXPECT_EQ(b.reg(P_SOLL), 0);
    b.send({0x01});
    EXPECT_EQ(b.reg(P_SOLL), 6);
    b.send({0x80});
    b.pause(3);
    b.send({0x80});
    EXPECT_EQ(b.reg(P_SOLL), 6) << "a pause breaks the pair";
    b.send({0x80});
    EXPECT_EQ(b.reg(P_SOLL), 5);
    b.send({0x01});
    b.send_one(0x55, true);
    b.send({0x01});
    EXPECT_EQ(b.reg(P_SOLL), 5) << "a framing error breaks the pair";
    b.send({0x01, 0xEA, 0xEA});
    EXPECT_EQ(b.reg(P_SOLL), 6);
    EXPECT_FALSE(b.motor.link().safe_communication());
    b.send({0x00});
    EXPECT_EQ(b.reg(P_SOLL), 5);
}

TEST(FastMacLink, ShortPauseKeepsThePair) {
    MotorBench b;
    b.set(P1, 5);
    b.send({0xEB});
    b.send({0x00});
    b.pause(1);
    b.send({0x00});
    EXPECT_EQ(b.reg(P_SOLL), 5);
}

// 001 §5.2.1.7: until synchronisation is re-established, for which the master pauses between characters.
TEST(FastMacLink, FramingErrorShowsUntilACharacterAfterAPause) {
    MotorBench b;
    b.set(P1, 5);
    b.send_one(0x80, true);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_EQ(b.reg(ERR_STAT), 1 << 8);
    EXPECT_EQ(b.status(), 0x04);
    b.send({0x60});  // not even a new command
    EXPECT_EQ(b.status(), 0x00);
    EXPECT_EQ(b.reg(ERR_STAT), 0);

    MotorBench c(registers::Model::mac800);
    c.send_one(0x80, true);
    EXPECT_EQ(c.reg(ERR_STAT), 0);
    EXPECT_EQ(c.status(), 0x04);
}

TEST(FastMacLink, FramingErrorShowsWhileCharactersComeWithoutAPause) {
    MotorBench b;
    b.send_one(0x60, true);
    b.send({0x60, 0x60, 0x60});
    EXPECT_EQ(b.reg(ERR_STAT), 1 << 8);
    b.send({0xE0});  // a command is taken meanwhile
    b.sent.clear();
    b.send({0xE0});
    EXPECT_EQ(b.sent.back(), 0x84);
    b.pause(1);
    b.send_one(0xE0, true);
    EXPECT_EQ(b.status(), 0x84) << "broken once more";
    b.send({0xE0});
    EXPECT_EQ(b.status(), 0x80);
    EXPECT_EQ(b.reg(ERR_STAT), 0);
}

// 13h: one character of pause after each, until the motor is reset.
TEST(FastMacLink, TransmitsSlowly) {
    MotorBench b;
    b.command(Number::transmit_slowly);
    b.pause(2);
    b.sent.clear();
    b.pause(20);
    EXPECT_EQ(b.sent.size(), 10U);
    b.motor.power_cycle();
    b.sent.clear();
    b.pause(20);
    EXPECT_EQ(b.sent.size(), 20U);
}

// 1Dh: after the toggle echo, in place of one status byte.
TEST(FastMacLink, TransmitsItsAddress) {
    MotorBench b(registers::Model::mac140, {.address = 0x2A});
    b.command(Number::transmit_address);
    b.sent.clear();
    b.pause(5);
    EXPECT_EQ(b.sent, (std::vector<std::uint8_t>{0x80, 0x80, 0x2A, 0x80, 0x80}));

    MotorBench c(registers::Model::mac800, {.address = 7});
    EXPECT_EQ(c.reg(202), 7);
    c.command(Number::transmit_address);
    c.sent.clear();
    c.pause(4);
    EXPECT_EQ(c.sent, (std::vector<std::uint8_t>{0x80, 0x80, 0x07, 0x80}));
}

TEST(FastMacLink, SwitchesToFlexMacAndBack) {
    MotorBench b;
    b.send({0xFF});  // 1Fh
    EXPECT_EQ(b.status(), 0x88);
    b.send({0x7E, 0x7E, 0x7E});
    EXPECT_EQ(b.status(), 0x00);
    b.send({0xE0});
    EXPECT_EQ(b.status(), 0x80);
}

// 001 §4.4.16, R: echoed, without effect; the link's own commands act.
TEST(FastMacLink, SafeMode) {
    MotorBench b;
    b.set(P1, 5);
    ASSERT_TRUE(b.motor.enter_safe_mode());
    b.send({0xC0});
    EXPECT_EQ(b.status(), 0x80);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_EQ(b.reg(MODE_REG), 15);
    ASSERT_EQ(b.motor.orders().size(), 1U);
    EXPECT_FALSE(b.motor.orders().back().effective);
    b.send({0x7F, 0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.status(), 0x88) << "taken and echoed";
    EXPECT_EQ(b.reg(V_SOLL), 1600);
    EXPECT_FALSE(b.motor.orders().back().effective);
    ASSERT_TRUE(b.motor.leave_safe_mode());
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
}

// 001 §3.2.36: USERINTF acts at reset; without communication the pins are something else.
TEST(FastMacLink, OnlyIfTheUserInterfaceIsCommunication) {
    MotorBench b;
    b.set(CNTRL_BITS, 0);
    b.pause(1);
    EXPECT_EQ(b.sent.size(), 1U);
    b.motor.store_registers();
    b.motor.power_cycle();
    b.sent.clear();
    b.send({0xC0});
    EXPECT_TRUE(b.sent.empty());
    EXPECT_TRUE(b.motor.orders().empty());
}

TEST(FastMacLink, OrderLogIsBounded) {
    MotorBench b(registers::Model::mac140, {.order_limit = 3});
    for (int n = 0; n < 10; ++n) b.command(static_cast<std::uint8_t>(n));
    ASSERT_EQ(b.motor.orders().size(), 3U);
    EXPECT_EQ(b.motor.orders().back().command, 9);
}

}  // namespace
}  // namespace nplc::sim
