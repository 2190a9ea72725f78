#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

void run_at(MotorBench& b, std::int32_t v_soll) {
    b.set(V_SOLL, v_soll);
    b.set(MODE_REG, 1);
    b.samples(300);
}

/// Follows STOP to its end: it goes on at every V_IST above `last_below`, and ends at the first that is not.
/// Answers the slowest that it went on at.
std::int32_t slowest_in_stop(MotorBench& b, std::int32_t last_below) {
    std::int32_t slowest = 100'000;
    for (int i = 0; i < 5000 && b.reg(MODE_REG) == 11; ++i) {
        b.samples(1);
        const std::int32_t v = std::abs(b.motor.v_ist());
        EXPECT_EQ(b.reg(MODE_REG), v > last_below ? 11 : 0) << v;
        if (v > last_below) slowest = std::min(slowest, v);
    }
    EXPECT_EQ(b.reg(MODE_REG), 0);
    return slowest;
}

TEST(Mode, StartsInInit) {
    MotorBench b;
    EXPECT_TRUE(b.motor.is_mode(MotorMode::init));
    EXPECT_FALSE(b.motor.in_position());
    EXPECT_EQ(b.reg(P_IST), 0);
    EXPECT_EQ(b.reg(ERR_STAT), 0);
    b.samples(10);
    EXPECT_EQ(b.motor.p_ist(), 0);
}

TEST(Mode, StartsInStartmode) {
    MotorBench b;
    b.set(STARTMODE, 2);
    b.motor.store_registers();
    b.motor.power_cycle();
    EXPECT_TRUE(b.motor.is_mode(MotorMode::position));
}

// 300 rpm are 39.3 counts/sample (001 §3.2.12: 7.629 rpm each): 39 is below, 40 is not; on MAC800 51.9 (004:
// 0.17316 counts/sample per rpm). Slow braking, a quarter of a count a sample, passes every count, or all but
// one that the encoder's step hides.
struct Stop {
    const char* name;
    registers::Model model;
    std::int32_t v_soll;
    std::int32_t last_below;
    double slowest;
    double tolerance;
};

struct StopEnds : testing::TestWithParam<Stop> {};

TEST_P(StopEnds, Below300Rpm) {
    const Stop& stop = GetParam();
    MotorBench b(stop.model);
    run_at(b, stop.v_soll);
    b.set(A_SOLL, 4);
    b.set(MODE_REG, 0);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    EXPECT_NEAR(slowest_in_stop(b, stop.last_below), stop.slowest, stop.tolerance);
    EXPECT_EQ(b.reg(FLWERR), 0);
    b.settle();
    EXPECT_EQ(b.motor.v_ist(), 0);
}

INSTANTIATE_TEST_SUITE_P(Mode, StopEnds,
                         testing::Values(Stop{"Forwards", registers::Model::mac140, 1600, 39, 40.5, 0.5},
                                         Stop{"Backwards", registers::Model::mac140, -1600, 39, 40.5, 0.5},
                                         Stop{"OnMac800", registers::Model::mac800, 1600, 51, 52, 1}),
                         [](const auto& one) { return std::string(one.param.name); });

// The two velocities themselves, about 640 / 16 = 40, as the encoder reads them in the first sample of STOP.
TEST(Mode, StopGoesOnAt40AndEndsAt39) {
    std::set<std::int32_t> went_on;
    std::set<std::int32_t> ended;
    for (int wait = 0; wait < 60; ++wait) {
        MotorBench b;
        run_at(b, 632 + wait % 10);
        b.samples(wait);
        b.set(MODE_REG, 0);
        EXPECT_EQ(b.reg(MODE_REG), 11);
        b.samples(1);
        (b.reg(MODE_REG) == 11 ? went_on : ended).insert(b.motor.v_ist());
    }
    ASSERT_FALSE(went_on.empty() || ended.empty());
    EXPECT_EQ(*went_on.begin(), 40);
    EXPECT_EQ(*ended.rbegin(), 39);
}

// R: A_SOLL = 0 still stops.
TEST(Mode, StopWithoutAccelerationUsesOne) {
    MotorBench b;
    run_at(b, 1600);
    b.set(A_SOLL, 0);
    b.set(MODE_REG, 0);
    const std::int32_t before = b.reg(FNC_OUT);
    b.samples(1);
    EXPECT_EQ(b.reg(FNC_OUT), before - 1);
}

TEST(Mode, StopsOutOfPositionMode) {
    MotorBench b;
    b.set(P_SOLL, 100'000);
    b.set(MODE_REG, 2);
    b.samples(100);
    b.set(MODE_REG, 0);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_LT(b.motor.p_ist(), 30'000);
    // R: P_FNC ran on with the shaft, so the interrupted move can be finished.
    EXPECT_EQ(b.reg(P_FNC), 16 * b.motor.p_ist());
    b.set(MODE_REG, 2);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 100'000);
}

TEST(Mode, InitClearsItsFlags) {
    MotorBench b;
    b.set(P_SOLL, 0);
    b.set(MODE_REG, 2);
    b.samples(10);
    EXPECT_TRUE(b.motor.in_position());
    b.set(MODE_REG, 0);
    b.samples(2);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.reg(ERR_STAT), 0);
}

// 001 §4.5.4
TEST(Mode, FollowErrorStopsTheMotor) {
    MotorBench b;
    b.set(FLWERRMAX, 200);
    b.set(ACC_EMERG, 500);
    run_at(b, 800);
    EXPECT_EQ(b.reg(MODE_REG), 1);
    b.motor.plant().load().torque = -2000;  // more than the motor has
    b.samples(20);
    EXPECT_NE(b.reg(ERR_STAT) & 0x02, 0);
    EXPECT_EQ(b.status() & 0x01, 0x01);
    b.motor.plant().load().torque = 0;
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.set(MODE_REG, 1);
    EXPECT_EQ(b.reg(MODE_REG), 0) << "an error keeps the motor in INIT";
    b.command(0x21);  // velocity mode, P2: register selected, mode kept
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.command(protocol::fastmac::Number::reset_error);
    EXPECT_EQ(b.status() & 0x01, 0);
    b.set(MODE_REG, 1);
    EXPECT_EQ(b.reg(MODE_REG), 1);
}

// 001 §4.5.5: a blocked motor's corrections add up.
TEST(Mode, FunctionErrorStopsTheMotor) {
    MotorBench b;
    b.set(FNCERRMAX, 5000);
    b.motor.plant().load().high_stop = MechanicalStop{3000};
    b.set(T_SOLL, 200);
    b.set(P_SOLL, 10'000);
    b.set(MODE_REG, 2);
    b.samples(2000);
    EXPECT_NE(b.reg(ERR_STAT) & 0x04, 0);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.p_ist(), 3000);
}

// 001 §4.5.3: both limits act as soon as one of them is not 0.
TEST(Mode, PositionLimits) {
    MotorBench b;
    b.set(MAX_P_IST, 5000);
    b.set(P_SOLL, 20'000);
    b.set(MODE_REG, 2);
    b.samples(300);
    EXPECT_NE(b.reg(ERR_STAT) & 0x80, 0);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.status() & 0x01, 0) << "a sequence does not see it";
    b.set(ERR_STAT, 0x4000);  // DIS_P_LIM
    b.set(MODE_REG, 2);
    b.until_in_position();
    EXPECT_EQ(b.reg(ERR_STAT) & 0x80, 0);

    MotorBench c;
    c.set(MAX_P_IST, 5000);
    c.set(P_SOLL, -500);  // MIN_P_IST is 0
    c.set(MODE_REG, 2);
    c.samples(100);
    EXPECT_NE(c.reg(ERR_STAT) & 0x80, 0);
}

TEST(Mode, EmergencyStopUsesItsOwnAcceleration) {
    for (const auto& [acc_emerg, taken] : {std::pair{400, 400}, {0, 10}}) {
        SCOPED_TRACE(acc_emerg);
        MotorBench b;
        b.set(ACC_EMERG, acc_emerg);
        b.set(MAX_P_IST, 15'000);
        b.set(A_SOLL, 10);
        b.set(V_SOLL, 1600);
        b.set(MODE_REG, 1);
        while (b.reg(MODE_REG) == 1) b.samples(1);
        const std::int32_t before = b.reg(FNC_OUT);
        b.samples(1);
        EXPECT_EQ(b.reg(FNC_OUT), before - taken);
    }
}

// The manual gives nothing but the purpose (001 §4.4.24).
TEST(Mode, TestTqIsPassiveAndSaysSo) {
    MotorBench b;
    run_at(b, 1600);
    b.set(MODE_REG, 23);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 23);
    EXPECT_EQ(b.motor.v_ist(), 0);
    EXPECT_EQ(b.reg(VF_OUT), 0);
    EXPECT_NE(b.motor.note().find("TESTTQ_MODE"), std::string_view::npos);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 2);
    EXPECT_TRUE(b.motor.note().empty());
    b.set(MODE_REG, 99);
    EXPECT_EQ(b.reg(MODE_REG), 2);
}

// 001 §4.4.16
TEST(Mode, SafeModeOnlyFromInitAndOnlyByItsOwnDoor) {
    MotorBench b;
    b.set(MODE_REG, 15);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.set(MODE_REG, 2);
    EXPECT_FALSE(b.motor.enter_safe_mode());
    b.set(MODE_REG, 0);
    b.samples(2);
    EXPECT_FALSE(b.motor.leave_safe_mode());
    EXPECT_TRUE(b.motor.enter_safe_mode());
    EXPECT_EQ(b.reg(MODE_REG), 15);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 15);
    EXPECT_TRUE(b.motor.leave_safe_mode());
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

TEST(Mode, PowerCycle) {
    MotorBench b;
    b.set(V1, 1234);
    b.motor.store_registers();
    b.set(V1, 99);
    b.set(P_SOLL, 3000);
    b.set(MODE_REG, 2);
    b.command(0x0B | 0x60);
    b.settle();
    b.motor.power_cycle();
    EXPECT_EQ(b.reg(V1), 1234);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.reg(P_IST), 0);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_FALSE(b.motor.link().toggle());
    EXPECT_FALSE(b.motor.link().safe_communication());
    b.samples(5);
    EXPECT_EQ(b.reg(P_IST), 0);
}

// 001 §3.2.163
TEST(Mode, Resynchronisation) {
    MotorBench b;
    b.set(P_SOLL, 500);
    b.set(MODE_REG, 2);
    b.settle();
    b.set(163, 7000);
    b.set(CNTRL_BITS, 0x0403);  // MAN_RESYNC
    b.samples(1);
    EXPECT_EQ(b.reg(P_SOLL), 7000);
    EXPECT_EQ(b.reg(P_IST), 7000);
    EXPECT_EQ(b.reg(P_FNC), 112'000);
    EXPECT_EQ(b.reg(CNTRL_BITS) & 0x1FFF, 3);  // bits 13 to 15 are the hall elements
    b.set(CNTRL_BITS, 0x1403);                 // and REL_RESYNC
    b.samples(1);
    EXPECT_EQ(b.reg(P_SOLL), 14'000);
    EXPECT_EQ(b.reg(P_IST), 14'000);
    EXPECT_EQ(b.reg(P_FNC), 224'000);
    b.set(MODE_REG, 0);
    b.set(CNTRL_BITS, 0x0203);  // AUTO_RESYNC
    b.samples(2);
    b.set(P_IST, 42);
    b.samples(1);
    EXPECT_EQ(b.reg(P_FNC), 672);
}

}  // namespace
}  // namespace nplc::sim
