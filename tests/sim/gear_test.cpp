#include "sim/profile_blocks.h"

#include <cstdlib>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int kVExt = 163, kGFnc = 165;  // on MAC800

// 001 §4.4.4's example: 500 pulses make one revolution of 4096 counts with 1024 / 125. 16 x 1024 / 125 are
// 131.072 a pulse; 500 of them 65,536 = 16 x 4096, whatever the portions.
TEST(Gear, TheRemainderIsKept) {
    for (const int portion : {1, 4, 20, 500}) {
        Gear gear;
        for (int sent = 0; sent < 500; sent += portion) gear.take(gear.scale(portion, 1024, 125));
        EXPECT_EQ(gear.g_fnc(), -65'536) << portion;
    }
    Gear one;
    one.take(one.scale(1, 1024, 125));
    EXPECT_EQ(one.g_fnc(), -131);
}

TEST(Gear, SignsOfPulsesAndFactor) {
    Gear gear;
    gear.take(gear.scale(3, -5, 2));  // 16 x 3 x -5 / 2 = -120
    EXPECT_EQ(gear.g_fnc(), 120);
    gear.take(gear.scale(-3, -5, 2));
    EXPECT_EQ(gear.g_fnc(), 0);
    gear.take(gear.scale(-3, 5, 2));
    gear.went(-100);
    EXPECT_EQ(gear.g_fnc(), 20);
}

TEST(Gear, ADivisorOfZeroGivesNothing) {
    Gear gear;
    gear.take(gear.scale(1000, 7, 0));
    EXPECT_EQ(gear.g_fnc(), 0);
}

TEST(Gear, AnotherDivisorBeginsWithoutRemainder) {
    Gear gear;
    gear.take(gear.scale(1, 4095, 65'535));  // 65,520 / 65,535: all of it remains
    gear.take(gear.scale(0, 1, 1));
    EXPECT_EQ(gear.g_fnc(), 0);
}

// 001 §4.1.3: V_NEW = -G_FNC, limited to V_SOLL, changed by A_SOLL at the most.
TEST(Gear, FollowBlock) {
    EXPECT_EQ(gear_follow_block(-300, 0, 1600, 160), 160);
    EXPECT_EQ(gear_follow_block(-300, 160, 1600, 160), 300);
    EXPECT_EQ(gear_follow_block(-5000, 1580, 1600, 160), 1600);
    EXPECT_EQ(gear_follow_block(5000, 0, 1600, 160), -160);
    EXPECT_EQ(gear_follow_block(0, 500, 1600, 160), 340);
}

/// A MAC800 in a gear mode. At 770 Hz, 77,000 pulses a second are 100 a sample.
struct GearBench : MotorBench {
    explicit GearBench(int mode) : MotorBench(registers::Model::mac800) {
        set(V_SOLL, 8000);
        set(A_SOLL, 100);
        set(14, 5);
        set(15, 2);
        set(MODE_REG, mode);
    }

    /// Runs so many samples, and `check` after each.
    void turn(int count, const auto& check) {
        for (int i = 0; i < count; ++i) {
            samples(1);
            pulses += reg(kVExt);
            check();
            if (testing::Test::HasFatalFailure()) return;
        }
    }
    void turn(int count) {
        turn(count, [] {});
    }

    std::int64_t pulses = 0;  ///< that came
};

// 100 x 5 / 2 = 250 counts/sample. What came is followed to the count once the pulses end: over 2000 pulses
// exactly 5000 counts.
TEST(Gear, PositionModeFollowsAndStopsWithoutOvershoot) {
    GearBench b(3);
    b.motor.terminals().set_pulse_rate(77'000);
    b.turn(300);
    EXPECT_NEAR(b.motor.v_ist(), 250, 2);
    EXPECT_FALSE(b.motor.in_position()) << "it is v^2 / 2a behind";
    b.motor.terminals().set_pulse_rate(0);
    b.turn(400, [&] { ASSERT_LE(b.reg(P_FNC), b.pulses * 40) << "passed: 16 x 5 / 2 for each pulse"; });
    EXPECT_EQ(b.reg(P_FNC), b.pulses * 40);
    EXPECT_NEAR(b.motor.p_ist(), static_cast<double>(b.pulses) * 2.5, 1);
    EXPECT_EQ(b.reg(kGFnc), 0);
    EXPECT_TRUE(b.motor.in_position());
}

// 001 §4.1.3: follows without a lag, and overshoots when the pulses stop suddenly.
TEST(Gear, FollowModeHasNoLagAndOvershoots) {
    GearBench b(24);
    b.motor.terminals().set_pulse_rate(77'000);
    b.turn(1500);
    EXPECT_NEAR(b.motor.v_ist(), 250, 2);
    EXPECT_EQ(b.reg(kGFnc), 0);
    EXPECT_TRUE(b.motor.in_position());
    b.motor.terminals().set_pulse_rate(0);
    std::int64_t farthest = 0;
    b.turn(1500, [&] { farthest = std::max<std::int64_t>(farthest, b.motor.p_ist()); });
    EXPECT_GT(farthest, b.pulses * 5 / 2 + 100);
    EXPECT_EQ(b.reg(P_FNC), b.pulses * 40);
}

TEST(Gear, TheSignOfGearf1TurnsTheDirection) {
    GearBench b(3);
    b.set(14, -5);
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(300);
    EXPECT_NEAR(b.motor.v_ist(), -250, 2);
}

// V_SOLL limits; what is missing meanwhile is made up for afterwards (001 §4.1.12).
TEST(Gear, WhatTheLimitTookIsMadeUpFor) {
    GearBench b(3);
    b.set(V_SOLL, 1600);
    b.motor.terminals().set_pulse_rate(77'000);
    const auto check = [&] { ASSERT_LE(b.reg(166) / 0x10000, 1600); };
    b.turn(300, check);
    b.motor.terminals().set_pulse_rate(0);
    b.turn(1200, check);
    EXPECT_EQ(b.reg(P_FNC), b.pulses * 40);
    b.settle();
    EXPECT_NEAR(b.motor.p_ist(), static_cast<double>(b.pulses) * 2.5, 1);
}

// 001 §4.1.12: an overload corrects the profile within T_SOLL; the follow error is made up for.
TEST(Gear, AnOverloadIsCorrectedAndMadeUpFor) {
    GearBench b(3);
    b.set(T_SOLL, 100);
    b.motor.terminals().set_pulse_rate(7'700);
    const auto check = [&] { ASSERT_LE(std::abs(b.reg(169)), 100); };
    b.turn(200, check);
    b.motor.plant().load().torque = -200;
    b.turn(25, check);
    b.motor.plant().load().torque = 0;
    b.turn(375, check);
    b.motor.terminals().set_pulse_rate(0);
    b.turn(3400, check);
    EXPECT_EQ(b.reg(P_FNC), b.pulses * 40);
    EXPECT_NEAR(b.motor.p_ist(), static_cast<double>(b.pulses) * 2.5, 1);
}

// When the overload is over the lag is v^2 / 2a as before: 25 counts/sample, 100 / 16 counts/sample^2: 50
// counts.
TEST(Gear, AnOverloadLeavesNoLag) {
    GearBench b(3);
    b.set(T_SOLL, 100);
    b.motor.terminals().set_pulse_rate(7'700);
    b.samples(200);
    b.motor.plant().load().torque = -200;
    b.samples(25);
    b.motor.plant().load().torque = 0;
    b.samples(2000);
    EXPECT_NEAR(b.motor.v_ist(), 25, 3);
    EXPECT_LE(std::abs(b.reg(kGFnc)), 16 * 100);
}

// 001 §3.2.24: in the gear modes FNCERR is what torque, acceleration and velocity took together, a
// positioning error. Pulses for 250 counts/sample against a V_SOLL of 100: 150 x 16 = 2400 more in each
// sample.
TEST(Gear, FncErrIsThePositioningError) {
    GearBench b(3);
    b.set(V_SOLL, 1600);
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(100);
    const std::int32_t before = b.reg(FNCERR);
    b.samples(10);
    EXPECT_NEAR(b.reg(FNCERR) - before, -24'000, 40) << "a pulse is 40";
    b.set(FNCERRMAX, std::abs(b.reg(FNCERR)) + 6000);
    b.samples(1);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x04, 0);
    b.samples(5);
    EXPECT_NE(b.reg(ERR_STAT) & 0x04, 0);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

// 001 §3.2.8, the flying saw: stands at its start in position mode; runs beside the job; position mode takes
// it back, for P_FNC ran on. Again and again from the same place.
TEST(Gear, FlyingSaw) {
    MotorBench b(registers::Model::mac800);
    b.set(V_SOLL, 8000);
    b.set(P_SOLL, 1234);
    b.set(MODE_REG, 2);
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 1234);
    b.motor.terminals().set_pulse_rate(77'000);  // the job passes: 100 counts/sample
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 1234);
    for (int job = 0; job < 3; ++job) {
        b.set(MODE_REG, 24);
        b.samples(400);
        EXPECT_NEAR(b.motor.v_ist(), 100, 2) << "sawing";
        EXPECT_EQ(b.reg(P_FNC) / 16 - 1234, 40'000) << "all 400 x 100 counts of the job";
        b.set(MODE_REG, 2);
        b.settle();
        EXPECT_EQ(b.motor.p_ist(), 1234);
        EXPECT_EQ(b.reg(P_FNC), 16 * 1234);
    }
}

TEST(Gear, PulsesBeforeTheModeDoNotCount) {
    MotorBench b(registers::Model::mac800);
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(100);
    b.motor.terminals().set_pulse_rate(0);
    b.samples(1);
    b.set(MODE_REG, 3);
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 0);
}

// 001 §3.2.36: with FastMAC on the pins there are no pulses; the motor stands, and reports the reason.
TEST(Gear, WithoutPinsTheMotorStandsAndSaysSo) {
    MotorBench b;
    b.motor.terminals().set_pulse_rate(50'000);
    b.set(MODE_REG, 3);
    b.samples(200);
    EXPECT_EQ(b.reg(MODE_REG), 3);
    EXPECT_EQ(b.motor.p_ist(), 0);
    EXPECT_NE(b.motor.note().find("USERINTF"), std::string_view::npos);
    b.set(MODE_REG, 2);
    EXPECT_TRUE(b.motor.note().empty());
}

// 001 §4.4.4: INIT comes through STOP.
TEST(Gear, InitComesThroughStop) {
    GearBench b(3);
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(300);
    b.set(MODE_REG, 0);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.v_ist(), 0);
}

}  // namespace
}  // namespace nplc::sim
