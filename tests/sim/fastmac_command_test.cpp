#include <algorithm>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
using protocol::fastmac::Number;

// The moves of 001 §5.2.1.5, in the codes of §5.2.1.4's list: NOP, P_IST = 0, T2, A4, V4 in INIT, P6, P7, V3,
// P5 in position mode. P_IST = 0 is command 03h.
TEST(FastMacCommand, ManualsExampleMovesTheMotor) {
    MotorBench b;
    b.set(P1 + 2 * 5, 4000);    // P6
    b.set(P1 + 2 * 6, 12'000);  // P7
    b.set(P1 + 2 * 4, -3000);   // P5
    b.set(V1 + 2, 500);
    b.set(V1 + 3, 1500);
    b.set(A1 + 3, 70);
    b.set(T1 + 1, 600);
    b.set(P_IST, 77);
    b.send({0xE0, 0x63, 0x95, 0x13, 0x8B});
    EXPECT_EQ(b.reg(P_IST), 0);
    EXPECT_EQ(b.reg(T_SOLL), 600);
    EXPECT_EQ(b.reg(A_SOLL), 70);
    EXPECT_EQ(b.reg(V_SOLL), 1500);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.send({0x45});
    EXPECT_EQ(b.reg(MODE_REG), 2);
    EXPECT_FALSE(b.motor.in_position());
    b.until_in_position();
    EXPECT_NEAR(b.motor.p_ist(), 4000, 32);
    b.send({0xC6});
    EXPECT_FALSE(b.motor.in_position());
    b.until_in_position();
    EXPECT_NEAR(b.motor.p_ist(), 12'000, 32);
    b.send({0x4A, 0xC4});
    EXPECT_EQ(b.reg(V_SOLL), 500);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), -3000);
    std::vector<int> taken;
    for (const Order& order : b.motor.orders()) taken.push_back(order.command);
    EXPECT_EQ(taken, (std::vector<int>{0x60, 0x63, 0x15, 0x13, 0x0B, 0x45, 0x46, 0x4A, 0x44}));
    EXPECT_TRUE(std::is_sorted(b.motor.orders().begin(), b.motor.orders().end(),
                               [](const Order& x, const Order& y) { return x.at < y.at; }));
}

// The bytes as printed in §5.2.1.5 from the third on: 03 A4, 93 V4, 5D P6, DE P7, 52 V3, DC P5 by the older
// code.
TEST(FastMacCommand, OlderRegisterCodes) {
    MotorBench b(registers::Model::mac140, {.old_register_codes = true});
    b.set(P1 + 2 * 5, 4000);
    b.set(P1 + 2 * 6, 6000);
    b.set(P1 + 2 * 4, -3000);
    b.set(V1 + 2, 500);
    b.set(V1 + 3, 1500);
    b.set(A1 + 3, 70);
    b.send({0xE0, 0x03, 0x93});
    EXPECT_EQ(b.reg(A_SOLL), 70);
    EXPECT_EQ(b.reg(V_SOLL), 1500);
    b.send({0x5D});
    EXPECT_EQ(b.reg(P_SOLL), 4000);
    b.send({0xDE});
    EXPECT_EQ(b.reg(P_SOLL), 6000);
    b.send({0x52, 0xDC});
    EXPECT_EQ(b.reg(V_SOLL), 500);
    EXPECT_EQ(b.reg(P_SOLL), -3000);
}

TEST(FastMacCommand, EveryRegisterInEveryMode) {
    for (int mode = 0; mode < 3; ++mode) {
        MotorBench b;
        b.set(A_SOLL, 0);
        for (int n = 0; n < 8; ++n) b.set(P1 + 2 * n, 10 * n + 1);
        for (int n = 0; n < 8; ++n) {
            b.command(static_cast<std::uint8_t>(mode << 5 | n));
            EXPECT_EQ(b.reg(P_SOLL), 10 * n + 1);
            b.command(static_cast<std::uint8_t>(mode << 5 | 8 | n));
            EXPECT_EQ(b.reg(V_SOLL), 400 * (n + 1));
        }
        for (int n = 0; n < 4; ++n) {
            b.set(T1 + n, 100 + n);
            b.set(L1 + n, 300 + n);
            b.set(Z1 + n, 30 + n);
            b.command(static_cast<std::uint8_t>(mode << 5 | 0x10 | n));
            EXPECT_EQ(b.reg(A_SOLL), 40 << n);
            b.command(static_cast<std::uint8_t>(mode << 5 | 0x14 | n));
            EXPECT_EQ(b.reg(T_SOLL), 100 + n);
            b.command(static_cast<std::uint8_t>(mode << 5 | 0x18 | n));
            EXPECT_EQ(b.reg(KVOUT), 300 + n);
            b.command(static_cast<std::uint8_t>(mode << 5 | 0x1C | n));
            EXPECT_EQ(b.reg(INPOSWIN), 30 + n);
        }
        EXPECT_EQ(b.reg(MODE_REG), mode);
    }
}

MotorBench in_position() {
    MotorBench b;
    b.set(P_SOLL, 3000);
    b.set(MODE_REG, 2);
    b.settle();
    EXPECT_TRUE(b.motor.in_position());
    return b;
}

TEST(FastMacCommand, ResetErrorKeepsRelativeAndLimitBits) {
    MotorBench b;
    b.set(ERR_STAT, 0x000F | 0x0080 | 0x0800 | 0x1000 | 0x0600 | 0x4000);
    b.command(Number::reset_error);
    EXPECT_EQ(b.reg(ERR_STAT), 0x4600);
}

TEST(FastMacCommand, Clears) {
    MotorBench b = in_position();
    b.command(Number::clear_p_ist);
    EXPECT_EQ(b.reg(P_IST), 0);
    EXPECT_TRUE(b.motor.in_position());
    b.command(Number::clear_in_pos);
    EXPECT_FALSE(b.motor.in_position());
    b.samples(3);
    EXPECT_TRUE(b.motor.in_position()) << "the next INPOSCNT samples find it in position again";
    b.command(Number::clear_v_soll);
    EXPECT_EQ(b.reg(V_SOLL), 0);
    b.command(Number::clear_p_soll);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_FALSE(b.motor.in_position());
    b.command(Number::clear_t_soll);
    EXPECT_EQ(b.reg(T_SOLL), 0);
    EXPECT_EQ(b.reg(FNC_OUT), 0);
}

// 04h, "step turntable": the target does not change, the motor makes the move again.
TEST(FastMacCommand, ClearPFnc) {
    MotorBench b = in_position();
    b.command(Number::clear_p_fnc);
    EXPECT_FALSE(b.motor.in_position());
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 6000);
    EXPECT_EQ(b.reg(P_FNC), 48'000);
}

// P_FNC = (FLWERR - P7) * 16, with P_SOLL = 0 and FLWERR = 0: P7 counts on.
TEST(FastMacCommand, MovesByPFnc) {
    MotorBench b;
    b.set(P1 + 2 * 6, 700);
    b.set(P1 + 2 * 7, -900);
    b.set(V_SOLL, 0);  // stands, so that the formula can be read
    b.set(MODE_REG, 2);
    b.command(Number::move_p7_by_p_fnc);
    EXPECT_EQ(b.reg(P_FNC), -700 * 16);
    b.command(Number::move_p8_by_p_fnc);
    EXPECT_EQ(b.reg(P_FNC), 900 * 16);
    b.set(FLWERR, 50);
    b.command(Number::move_p7_by_p_fnc);
    EXPECT_EQ(b.reg(P_FNC), (50 - 700) * 16);

    MotorBench c;
    c.set(P1 + 2 * 6, 700);
    c.set(MODE_REG, 2);
    c.samples(5);
    EXPECT_TRUE(c.motor.in_position());
    c.command(Number::move_p7_by_p_fnc);
    c.samples(1);
    EXPECT_FALSE(c.motor.in_position());
    c.until_in_position();
    c.settle();
    EXPECT_EQ(c.motor.p_ist(), 700);
    EXPECT_EQ(c.reg(P_FNC), 0);
}

// P_SOLL = P_IST + P7 - FLWERR
TEST(FastMacCommand, MovesByPSoll) {
    MotorBench b;
    b.set(P1 + 2 * 6, 700);
    b.set(P1 + 2 * 7, -900);
    b.set(V_SOLL, 0);
    b.set(MODE_REG, 2);
    b.set(P_IST, 1000);
    b.set(FLWERR, 30);
    b.command(Number::move_p7_by_p_soll);
    EXPECT_EQ(b.reg(P_SOLL), 1000 + 700 - 30);
    b.command(Number::move_p8_by_p_soll);
    EXPECT_EQ(b.reg(P_SOLL), 1000 - 900 - 30);

    MotorBench c = in_position();
    c.set(P1 + 2 * 7, -900);
    c.command(Number::move_p8_by_p_soll);
    c.samples(1);
    c.until_in_position();
    c.settle();
    EXPECT_EQ(c.motor.p_ist(), 2100);
}

TEST(FastMacCommand, RegisterSets) {
    MotorBench b;
    for (int set = 0; set < 4; ++set) {
        b.set(P1 + 2 * set, 100 + set);
        b.set(T1 + set, 200 + set);
        b.set(L1 + set, 300 + set);
        b.set(Z1 + set, 20 + set);
        b.set(ERR_STAT, 0x10);
        b.command(static_cast<std::uint8_t>(0x6C + set));
        EXPECT_EQ(b.reg(P_SOLL), 100 + set);
        EXPECT_EQ(b.reg(V_SOLL), 400 * (set + 1));
        EXPECT_EQ(b.reg(A_SOLL), 40 << set);
        EXPECT_EQ(b.reg(T_SOLL), 200 + set);
        EXPECT_EQ(b.reg(KVOUT), 300 + set);
        EXPECT_EQ(b.reg(INPOSWIN), 20 + set);
        EXPECT_FALSE(b.motor.in_position());
        EXPECT_EQ(b.reg(MODE_REG), 0);
    }
}

// The high byte of HOME_MODE, where it is a homing mode.
TEST(FastMacCommand, Home) {
    MotorBench b;
    b.command(Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.set(HOME_MODE, 0x0D0C);
    b.command(Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 13);
    b.set(HOME_MODE, 0x0200);
    b.set(MODE_REG, 0);
    b.settle();
    b.command(Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

TEST(FastMacCommand, AbsoluteAndRelative) {
    MotorBench b;
    b.command(Number::positions_relative_p_soll);
    EXPECT_EQ(b.reg(ERR_STAT), 1 << 9);
    b.command(Number::positions_relative_p_fnc);
    EXPECT_EQ(b.reg(ERR_STAT), 1 << 10);
    b.command(Number::positions_absolute);
    EXPECT_EQ(b.reg(ERR_STAT), 0);
}

TEST(FastMacCommand, NopsDoNothingAndAreTaken) {
    MotorBench b = in_position();
    for (const int number : {0x00, 0x17, 0x18, 0x19, 0x1A, 0x1B, 0x1C, 0x1E}) {
        const bool toggle = b.motor.link().toggle();
        b.command(static_cast<std::uint8_t>(0x60 | number));
        EXPECT_NE(b.motor.link().toggle(), toggle);
        EXPECT_TRUE(b.motor.in_position());
        EXPECT_EQ(b.reg(P_SOLL), 3000);
        EXPECT_FALSE(b.motor.link().flexmac());
    }
}

// R: with an error the register is selected, the mode stays.
TEST(FastMacCommand, ErrorsKeepInit) {
    for (const int bit : {0, 1, 2, 3, 7, 12}) {
        MotorBench b;
        b.set(ERR_STAT, 1 << bit);
        b.set(P1 + 2, 4711);
        b.command(0x41);
        EXPECT_EQ(b.reg(MODE_REG), 0) << bit;
        EXPECT_EQ(b.reg(P_SOLL), 4711) << bit;
        EXPECT_TRUE(b.motor.link().toggle()) << bit;
        EXPECT_EQ(b.status() & 1, bit <= 3 ? 1 : 0) << bit;
        b.command(Number::reset_error);
        b.command(0x41);
        EXPECT_EQ(b.reg(MODE_REG), 2) << bit;
    }
    MotorBench b;
    b.set(ERR_STAT, 1 << 11);
    b.command(0x41);
    EXPECT_EQ(b.reg(MODE_REG), 2);
}

TEST(FastMacCommand, InitGoesThroughStop) {
    MotorBench b;
    b.set(P1, 100'000);
    b.command(0x40);
    b.samples(100);
    b.command(0x08);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

}  // namespace
}  // namespace nplc::sim
