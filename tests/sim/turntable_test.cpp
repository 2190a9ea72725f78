// Relative positioning as 001 §4.1.2 works it out: 100,000 counts again and again.
#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

MotorBench turntable(protocol::fastmac::Number way) {
    MotorBench b;
    b.set(P1, 100'000);
    b.set(V_SOLL, 8000);
    b.set(A_SOLL, 500);
    b.command(way);
    b.set(MODE_REG, 2);
    return b;
}

// P_FNC = 1,600,000 after one. P_SOLL's range is +/- 67E6: 670 times; with the 671st it is out of range.
TEST(Turntable, ByPSollItEndsAfter670) {
    MotorBench b = turntable(protocol::fastmac::Number::positions_relative_p_soll);
    b.set(P_REG_P, 1);
    EXPECT_EQ(b.reg(P_REG_P), 0);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 100'000);
    EXPECT_EQ(b.reg(P_FNC), 1'600'000);
    for (int n = 1; n < 670; ++n) b.set(P_REG_P, 1);
    EXPECT_EQ(b.reg(P_SOLL), 67'000'000);
    b.set(P_REG_P, 1);
    EXPECT_GT(b.reg(P_SOLL), 67'000'000);
}

// By P_FNC: after each move P_FNC is 0, P_SOLL too; only P_IST has the position.
TEST(Turntable, ByPFncItGoesOn) {
    MotorBench b = turntable(protocol::fastmac::Number::positions_relative_p_fnc);
    for (int n = 1; n <= 20; ++n) {
        b.set(P_REG_P, 1);
        EXPECT_EQ(b.reg(P_FNC), -1'600'000);
        EXPECT_FALSE(b.motor.in_position());
        b.until_in_position();
        b.settle();
        EXPECT_EQ(b.reg(P_FNC), 0);
        EXPECT_EQ(b.reg(P_SOLL), 0);
        EXPECT_EQ(b.motor.p_ist(), n * 100'000);
    }
}

// Ordered before the last is done, none is lost: the distances add up.
TEST(Turntable, OrdersInMotionAddUp) {
    MotorBench b = turntable(protocol::fastmac::Number::positions_relative_p_fnc);
    for (int n = 0; n < 5; ++n) {
        b.command(0x40);
        b.samples(7);
    }
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 500'000);
    EXPECT_EQ(b.reg(P_FNC), 0);
}

}  // namespace
}  // namespace nplc::sim
