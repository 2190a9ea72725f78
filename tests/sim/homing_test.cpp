#include "sim/profile_blocks.h"

#include <cstdlib>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

// 001 §3.2.41: T_HOME 800 is the most that 1.25 times fits into 1023.
TEST(Homing, PeakTorque) {
    EXPECT_EQ(Homing::torque_limit(800), 1000);
    EXPECT_EQ(Homing::torque_limit(-300), 375);
}

// 001 §4.4.15: -V_HOME / 64 + 1. -(-400) / 64 = 6.25, so 7; -400 / 64 = -6.25, so -6 + 1. With 64 it would be
// 0, with 63 +1, towards the sensor: R: 1 away.
TEST(Homing, Creep) {
    EXPECT_EQ(Homing::creep(-400), 7);
    EXPECT_EQ(Homing::creep(400), -5);
    EXPECT_EQ(Homing::creep(64), -1);
    EXPECT_EQ(Homing::creep(63), -1);
    EXPECT_EQ(Homing::creep(-10), 1);
}

// 001 §3.2.41: exceeded 50 times; R: in total, not in a row, and T_HOME by its magnitude.
TEST(Homing, FiftySamplesAboveTheTorqueInTotal) {
    Homing homing;
    homing.begin(Homing::Method::torque);
    const auto step = [&](std::int32_t torque) {
        return homing.step({.v_home = -400, .t_home = 300, .torque = torque, .sensor = false});
    };
    for (int i = 0; i < 49; ++i) {
        EXPECT_FALSE(step(-301)) << i;
        EXPECT_FALSE(step(-300)) << i;
    }
    EXPECT_EQ(homing.velocity(), -400);
    EXPECT_TRUE(step(301));
}

TEST(Homing, SensorOnIsTheZeroAndIsLeftFirst) {
    Homing homing;
    homing.begin(Homing::Method::sensor_on);
    const auto step = [&](bool sensor) {
        return homing.step({.v_home = -400, .t_home = 1, .torque = 0, .sensor = sensor});
    };
    EXPECT_FALSE(step(true));
    EXPECT_EQ(homing.velocity(), 400);
    EXPECT_FALSE(step(false));
    EXPECT_EQ(homing.velocity(), -400);
    EXPECT_TRUE(step(true));
}

TEST(Homing, SensorLeftIsTheZeroAfterACreep) {
    Homing homing;
    homing.begin(Homing::Method::sensor_left);
    const auto step = [&](bool sensor) {  // active low
        return homing.step({.v_home = -400, .t_home = -1, .torque = 0, .sensor = !sensor});
    };
    EXPECT_FALSE(step(false));
    EXPECT_EQ(homing.velocity(), -400);
    EXPECT_FALSE(step(true));
    EXPECT_EQ(homing.velocity(), 7);
    EXPECT_FALSE(step(true));
    EXPECT_TRUE(step(false));
}

/// Homing by the FastMAC command, position mode afterwards.
void set_up(MotorBench& b, int home_mode, std::int32_t p_home = 0) {
    b.set(HOME_MODE, home_mode << 8);
    b.set(STARTMODE, 2);
    b.set(V_HOME, -400);
    b.set(T_HOME, 300);
    b.set(P_HOME, p_home);
}

void home(MotorBench& b, int limit = 5000) {
    b.command(protocol::fastmac::Number::home);
    for (int i = 0; i < limit && b.reg(MODE_REG) != 2; ++i) {
        b.samples(1);
        ASSERT_FALSE(b.motor.in_position()) << "001 §4.4.13: IN_POS = 0";
    }
    ASSERT_EQ(b.reg(MODE_REG), 2);
}

// 001 §4.4.13. The stop is 3000 counts away; at 25 counts/sample that is 120 samples and some to accelerate,
// 50 more at the stop. The torque stays within 1.25 x 300 although T_SOLL is 1023.
TEST(Homing, Home1FindsTheStop) {
    MotorBench b;
    set_up(b, 12);
    b.motor.plant().load().low_stop = MechanicalStop{-3000};
    b.set(V_SOLL, 1234);
    b.command(protocol::fastmac::Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 12);
    int samples = 0;
    std::int32_t most = 0;
    while (b.reg(MODE_REG) == 12 && samples < 1000) {
        b.samples(1);
        ++samples;
        most = std::max(most, std::abs(b.reg(VF_OUT)));
    }
    EXPECT_GE(samples, 120 + 50);
    EXPECT_EQ(most, 375);
    EXPECT_EQ(b.reg(MODE_REG), 2);
    EXPECT_EQ(b.reg(V_SOLL), 1234);
    EXPECT_EQ(b.reg(T_SOLL), 1023);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_EQ(b.reg(FNCERR), 0);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 0);
    EXPECT_EQ(b.motor.plant().counts(), -3000);
    b.set(P_SOLL, 5000);
    b.settle();
    EXPECT_EQ(b.motor.plant().counts(), 2000);
}

// P_SOLL = 0 literally: with P_HOME = -500 the stop is at -500 and position mode goes 500 counts off it.
TEST(Homing, PHomeIsThePositionOfTheZero) {
    MotorBench b;
    set_up(b, 12, -500);
    b.motor.plant().load().low_stop = MechanicalStop{-3000};
    home(b);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 0);
    EXPECT_EQ(b.motor.plant().counts(), -2500);
}

TEST(Homing, Home1AgainstACompliantStop) {
    MotorBench b;
    set_up(b, 12);
    b.motor.plant().load().low_stop = MechanicalStop{-3000, 1024};  // 300 of torque after 300 counts
    home(b);
    b.settle();
    EXPECT_LT(b.motor.plant().counts(), -3300);
    EXPECT_GT(b.motor.plant().counts(), -3400);
}

// V_HOME's sign is the direction.
TEST(Homing, ForwardsToo) {
    MotorBench b;
    set_up(b, 12);
    b.set(V_HOME, 400);
    b.motor.plant().load().high_stop = MechanicalStop{3000};
    home(b);
    b.settle();
    EXPECT_EQ(b.motor.plant().counts(), 3000);
    EXPECT_EQ(b.motor.p_ist(), 0);
}

/// Where the shaft stands at P_IST = 0 after a search for a sensor that is on below -3000.
std::int64_t sensor_zero(int home_mode, std::int64_t start_at, bool active_low = false) {
    MotorBench b;
    b.motor.plant().load().low_stop = MechanicalStop{start_at};  // a stop beyond the shaft puts it there
    b.motor.plant().load().high_stop = MechanicalStop{start_at};
    b.samples(1);
    b.motor.plant().load().low_stop.reset();
    b.motor.plant().load().high_stop.reset();
    set_up(b, home_mode);
    b.motor.terminals().connect({.counts = -3000, .on_above = active_low});
    if (active_low) b.set(T_HOME, -300);
    if (home_mode == 14) b.set(A_SOLL, 20);
    home(b, 20'000);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 0);
    return b.motor.plant().counts();
}

// At 25 counts/sample the zero is at most that far behind the sensor's edge.
TEST(Homing, Home2FindsTheSensorFromEitherSide) {
    for (const int start : {0, -5000}) {
        for (const bool active_low : {false, true}) {
            const std::int64_t zero = sensor_zero(13, start, active_low);
            EXPECT_LE(zero, -3000) << start;
            EXPECT_GE(zero, -3026) << start;
        }
    }
}

// HOME3 leaves the sensor at 7/16 counts a sample: on the count, once it turns 250 counts behind the edge
// (25^2 / 2 / 1.25) and has time to calm down.
TEST(Homing, Home3FindsTheEdgeToTheCount) {
    for (const int start : {0, -5000}) {
        EXPECT_NEAR(static_cast<double>(sensor_zero(14, start)), -3000, 1) << start;
        EXPECT_NEAR(static_cast<double>(sensor_zero(14, start, true)), -3000, 1) << start;
    }
}

// 001 §4.4.14: the torque limit is T_SOLL here.
TEST(Homing, Home2UsesTSoll) {
    MotorBench b;
    set_up(b, 13);
    b.set(T_SOLL, 50);
    b.motor.plant().load().low_stop = MechanicalStop{-1000};
    b.command(protocol::fastmac::Number::home);
    b.samples(500);
    EXPECT_EQ(b.reg(MODE_REG), 13) << "it never finds a sensor";
    EXPECT_EQ(b.reg(VF_OUT), -50);
}

// 001 §3.2.42: low byte at power-up, high byte for the command, 0: none. STARTMODE takes over.
TEST(Homing, AtPowerUpByTheLowByte) {
    MotorBench b;
    set_up(b, 0);
    b.set(HOME_MODE, 12);
    b.command(protocol::fastmac::Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.motor.plant().load().low_stop = MechanicalStop{-500};
    b.motor.store_registers();
    b.motor.power_cycle();
    EXPECT_EQ(b.reg(MODE_REG), 12);
    b.samples(500);
    EXPECT_EQ(b.reg(MODE_REG), 2);
}

TEST(Homing, AStartModeThatIsNoneEndsInInit) {
    for (const int start_mode : {0, 12, 15, 99}) {
        MotorBench b;
        set_up(b, 12);
        b.set(STARTMODE, start_mode);
        b.motor.plant().load().low_stop = MechanicalStop{-500};
        b.command(protocol::fastmac::Number::home);
        b.samples(500);
        EXPECT_EQ(b.reg(MODE_REG), 0) << start_mode;
        EXPECT_EQ(b.motor.p_ist(), 0) << start_mode;
    }
}

// 001 §4.4.13: FLWERR accumulates, FLW_ERR is monitored (INTERPRETATION: in homing too). Torque 375 against a
// stop: 25 counts a sample are lost, 20 samples make 500.
TEST(Homing, FollowErrorIsMonitored) {
    MotorBench b;
    set_up(b, 12);
    b.set(FLWERRMAX, 500);
    b.motor.plant().load().low_stop = MechanicalStop{-1000};
    b.command(protocol::fastmac::Number::home);
    b.samples(300);
    EXPECT_NE(b.reg(ERR_STAT) & 0x02, 0);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.status() & 0x01, 1);
    b.command(protocol::fastmac::Number::home);
    EXPECT_EQ(b.reg(MODE_REG), 0) << "an error keeps the motor in INIT";
}

// 001 §3.2.35: homing outside of the limits needs DIS_P_LIM.
TEST(Homing, PositionLimitsNeedToBeDisabled) {
    for (const bool disabled : {false, true}) {
        MotorBench b;
        set_up(b, 12);
        b.set(MIN_P_IST, -100);
        b.set(MAX_P_IST, 50'000);
        if (disabled) b.set(ERR_STAT, 0x4000);
        b.motor.plant().load().low_stop = MechanicalStop{-3000};
        b.command(protocol::fastmac::Number::home);
        b.samples(600);
        EXPECT_EQ(b.reg(MODE_REG), disabled ? 2 : 0);
        EXPECT_EQ((b.reg(ERR_STAT) & 0x80) != 0, !disabled);
    }
}

// INIT ends a search; V_SOLL = 0 does not (R: V_HOME is the velocity).
TEST(Homing, InitEndsItAndAStopDoesNot) {
    MotorBench b;
    set_up(b, 12);
    b.command(protocol::fastmac::Number::home);
    b.samples(100);
    b.command(protocol::fastmac::Number::clear_v_soll);
    b.samples(50);
    EXPECT_EQ(b.reg(MODE_REG), 12);
    EXPECT_NEAR(b.motor.v_ist(), -25, 1);
    b.set(MODE_REG, 0);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.v_ist(), 0);
    EXPECT_EQ(b.reg(T_SOLL), 1023);
}

// 001 §3.2.36: two markers a revolution, 2048 counts apart. The stop at -3000 is nearest to the marker at
// -2048 (952 away; -4096 is 1096): that marker is P_HOME, the stop 952 counts below it.
TEST(Homing, IndexHomeRoundsToTheMarker) {
    MotorBench b;
    set_up(b, 12);
    b.set(CNTRL_BITS, 0x0803);
    b.motor.plant().load().low_stop = MechanicalStop{-3000};
    home(b);
    EXPECT_EQ(b.motor.p_ist(), -952);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.plant().counts(), -2048);
}

// 004: HOME_MODE bit 16 is Home_Done; one index a revolution.
TEST(Homing, Mac800ShowsThatItIsDone) {
    MotorBench b(registers::Model::mac800);
    set_up(b, 12);
    b.motor.plant().load().low_stop = MechanicalStop{-3000};
    home(b);
    EXPECT_EQ(b.reg(HOME_MODE), 0x10C00);
    b.command(protocol::fastmac::Number::home);
    EXPECT_EQ(b.reg(HOME_MODE), 0x0C00);
}

}  // namespace
}  // namespace nplc::sim
