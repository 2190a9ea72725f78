#include <array>
#include <random>
#include <utility>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
using registers::Model;

// 001 §4.2.1: a move that asks for more than T_SOLL is corrected, and still ends on its target.
TEST(Load, FunctionCorrectionKeepsTheTorque) {
    MotorBench b;
    b.set(T_SOLL, 60);
    b.set(A_SOLL, 800);  // 800 / 3500 of full torque: 234
    b.set(P_SOLL, 20'000);
    b.set(MODE_REG, 2);
    for (int i = 0; i < 1500; ++i) {
        b.samples(1);
        ASSERT_LE(std::abs(b.reg(VF_OUT)), 60);
        ASSERT_LE(std::abs(b.reg(FLWERR)), 300);
        ASSERT_LE(std::abs(b.reg(P_FNC) / 16 - b.reg(FLWERR) - b.motor.p_ist()), 1);
    }
    EXPECT_NE(b.reg(FNCERR), 0);
    EXPECT_EQ(b.motor.p_ist(), 20'000);
    EXPECT_EQ(b.reg(FLWERR), 0);
    EXPECT_TRUE(b.motor.in_position());
}

// Whatever the torque, the load and how well KVOUT fits it: the motor ends on its target and stays there. The
// current loop's own swing may move one in fifty by a count.
void end_on_the_target(Servo::Depth depth, int most_stepping) {
    std::mt19937 random(5);
    const auto between = [&](int low, int high) {
        return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low));
    };
    int stepping = 0;
    for (int round = 0; round < 120; ++round) {
        MotorBench b(round % 4 == 0 ? registers::Model::mac800 : registers::Model::mac140, {.depth = depth});
        const int kvout_256 = between(256, 768);
        b.set(KVOUT, round % 4 == 0 ? kvout_256 * 256 : kvout_256);
        b.motor.plant().load().inertia_256 = kvout_256 * between(50, 300) / 100;
        b.motor.plant().load().friction_torque = between(1, 20);
        b.motor.plant().load().torque = between(-20, 20);
        b.set(T_SOLL, between(50, 1023));
        b.set(A_SOLL, between(20, 1000));
        b.set(V_SOLL, between(500, 4000));
        const int target = between(-30'000, 30'000);
        b.set(P_SOLL, target);
        b.set(MODE_REG, 2);
        b.samples(5000);
        bool exact = b.motor.p_ist() == target;
        for (int i = 0; i < 500; ++i) {
            b.samples(1);
            ASSERT_NEAR(b.motor.p_ist(), target, 1) << "seed 5, round " << round;
            ASSERT_TRUE(b.motor.in_position()) << "seed 5, round " << round;
            exact = exact && b.motor.p_ist() == target;
        }
        if (!exact) ++stepping;
    }
    EXPECT_LE(stepping, most_stepping);
}

TEST(Load, RandomLoadsAndLimitsEndOnTheTarget) {
    end_on_the_target(Servo::Depth::current_loop, 2);
    end_on_the_target(Servo::Depth::outer_loop, 0);
}

// 100 of pull against 100 of friction, in motion and let go: it comes to rest, and stays.
TEST(Load, AShaftDoesNotCreepWhereTorqueEqualsFriction) {
    Plant shaft(3500 / 16.0, 1, {.friction_torque = 100, .torque = 100});
    shaft.step(1);
    const std::int64_t pushed = shaft.counts();
    shaft.step(-1);
    for (int i = 0; i < 1000; ++i) shaft.step(0);
    EXPECT_EQ(shaft.velocity(), 0);
    EXPECT_LE(shaft.counts() - pushed, 1);
    for (int i = 0; i < 20; ++i) shaft.step(1);
    EXPECT_GT(shaft.velocity(), 2) << "a unit of torque more moves it: 3500 / 16 / 1023 = 0.21 a sample";
}

// 001 §3.2.24's example: held in place, the corrections add up while the position error stays.
TEST(Load, BlockedMotorAccumulatesFunctionError) {
    MotorBench b;
    b.motor.plant().load().high_stop = MechanicalStop{1000};
    b.set(T_SOLL, 100);
    b.set(P_SOLL, 5000);
    b.set(MODE_REG, 2);
    b.samples(1000);
    EXPECT_EQ(b.motor.p_ist(), 1000);
    const std::int32_t early = std::abs(b.reg(FNCERR));
    b.samples(1000);
    EXPECT_GT(std::abs(b.reg(FNCERR)), early);
    EXPECT_EQ(b.motor.p_ist(), 1000);
    EXPECT_FALSE(b.motor.in_position());
    b.motor.plant().load().high_stop.reset();
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 5000);
}

// A press: what it may push with, it pushes with, from half a second after it meets the work on, however
// gently it came.
TEST(Load, AgainstAHardStopTheTorqueStandsAtItsLimit) {
    for (const std::int32_t acceleration : {5, 20, 40, 160, 640}) {
        for (const std::int32_t kvout : {256, 448, 1024}) {
            for (const std::int32_t torque : {100, 307, 818, 1023}) {
                MotorBench b;
                b.motor.plant().load().high_stop = MechanicalStop{20'000};
                b.motor.plant().load().inertia_256 = kvout;
                b.set(KVOUT, kvout);
                b.set(A_SOLL, acceleration);
                b.set(T_SOLL, torque);
                b.set(P_SOLL, 1'000'000);
                b.set(MODE_REG, 2);
                int waited = 0;
                while (b.motor.p_ist() < 20'000 && waited < 5000) {
                    b.samples(1);
                    ++waited;
                }
                b.samples(260);
                for (int i = 0; i < 500; ++i) {
                    b.samples(1);
                    ASSERT_EQ(b.reg(VF_OUT), torque)
                        << "A_SOLL " << acceleration << ", KVOUT " << kvout << ", sample " << i;
                    ASSERT_EQ(b.motor.p_ist(), 20'000);
                }
            }
        }
    }
}

// A passive motor's windings brake what pulls it, less so the faster it turns.
TEST(Load, BothDepthsLetAPassiveMotorTurnEquallyFast) {
    for (const auto& [model, pull] :
         {std::pair{Model::mac140, 500}, {Model::mac140, 900}, {Model::mac800, 500}}) {
        std::array<double, 2> speeds{};
        for (const auto depth : {Servo::Depth::current_loop, Servo::Depth::outer_loop}) {
            MotorBench b(model, {.depth = depth});
            b.motor.plant().load().torque = pull;
            b.samples(2000);
            speeds[static_cast<std::size_t>(depth)] = b.motor.v_ist();
        }
        EXPECT_NEAR(speeds[1], speeds[0], speeds[0] / 50) << pull;
    }
}

// 001 §4.1.8: STOP decelerates by A_SOLL, also a profile that a load has turned round.
TEST(Load, AnOverhauledMotorStopsByASoll) {
    MotorBench b;
    b.motor.plant().load().torque = -400;
    b.set(T_SOLL, 200);
    b.set(P_SOLL, 1'000'000);
    b.set(MODE_REG, 2);
    b.samples(30);
    const std::int32_t before = b.reg(FNC_OUT);
    ASSERT_LT(before, -100) << "the load pulls it back";
    b.set(A_SOLL, 5);
    b.set(MODE_REG, 0);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    EXPECT_NEAR(b.reg(FNC_OUT), before, 5);
}

// 001 §3.2.34: the samples of another mode do not count.
TEST(Load, InPositionIsCountedAnewInEachMode) {
    MotorBench b;
    b.set(INPOSCNT, 50);
    b.set(V_SOLL, 0);
    b.set(MODE_REG, 1);
    b.samples(60);
    ASSERT_TRUE(b.motor.in_position());
    b.set(MODE_REG, 2);
    b.samples(48);
    EXPECT_FALSE(b.motor.in_position());
    b.samples(4);
    EXPECT_TRUE(b.motor.in_position());
}

// What a blocked move learnt of braking does not slow the next one: 20,000 counts at 1600 / 16 = 100 counts a
// sample take 200 samples and 10 to start.
TEST(Load, AMoveAwayFromAnObstacleIsAsFastAsAny) {
    MotorBench b;
    b.motor.plant().load().high_stop = MechanicalStop{20'000};
    b.set(T_SOLL, 300);
    b.set(P_SOLL, 25'000);
    b.set(MODE_REG, 2);
    b.samples(2000);
    EXPECT_EQ(b.motor.p_ist(), 20'000);
    b.set(P_SOLL, 0);
    EXPECT_LE(b.until_in_position(), 240);
}

// In velocity mode nothing is corrected: FLWERR shows what is lost, and the motor does not race to regain it.
TEST(Load, BlockedInVelocityModeCountsFollowError) {
    MotorBench b;
    b.motor.plant().load().high_stop = MechanicalStop{1000};
    b.set(T_SOLL, 100);
    b.set(V_SOLL, 800);
    b.set(MODE_REG, 1);
    b.samples(520);
    EXPECT_EQ(b.reg(FNCERR), 0);
    EXPECT_GT(b.reg(FLWERR), 20'000);  // about 500 samples x 50 counts
    b.motor.plant().load().high_stop.reset();
    for (int i = 0; i < 500; ++i) {
        b.samples(1);
        ASSERT_LE(b.motor.v_ist(), 100);
    }
    EXPECT_NEAR(b.motor.v_ist(), 50, 1);
    // Into position mode: what was lost is taken off P_FNC, the target in P_IST's terms holds.
    b.set(P_SOLL, 0);
    b.set(MODE_REG, 2);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 0);
}

// 004, MAN_NO_BRAKE: a brake that is built in holds what pulls until the motor is ordered to drive, or to let
// go.
TEST(Load, TheBrakeOfAMac800HoldsTheShaft) {
    constexpr std::int32_t kManNoBrake = 0x80;
    MotorBench b(registers::Model::mac800);
    b.motor.plant().load().torque = 100;
    b.motor.plant().load().brake_torque = 300;
    b.samples(200);
    EXPECT_TRUE(b.motor.brake_output());
    EXPECT_EQ(b.motor.p_ist(), 0);
    b.set(P_SOLL, 2000);
    b.set(MODE_REG, 2);
    b.until_in_position();
    EXPECT_FALSE(b.motor.brake_output());
    b.set(MODE_REG, 0);
    b.samples(500);
    EXPECT_TRUE(b.motor.brake_output());
    const std::int32_t held = b.motor.p_ist();
    b.samples(200);
    EXPECT_EQ(b.motor.p_ist(), held);
    b.set(CNTRL_BITS, kManNoBrake);
    b.samples(200);
    EXPECT_GT(b.motor.p_ist(), held + 100);
    b.motor.plant().load().brake_torque = 50;
    b.set(CNTRL_BITS, 0);
    b.samples(200);
    EXPECT_GT(b.motor.v_ist(), 0) << "too weak for the pull";
}

TEST(Load, ConstantPullAndMoreInertia) {
    for (const std::int32_t kvout_256 : {0x100, 0x200, 0x300}) {
        MotorBench b;
        b.motor.plant().load().inertia_256 = 0x200;
        b.motor.plant().load().torque = -80;
        b.set(KVOUT, kvout_256);
        b.set(A_SOLL, 60);
        b.set(MODE_REG, 2);
        b.samples(300);
        b.set(P_SOLL, 12'345);
        b.samples(1500);
        EXPECT_EQ(b.motor.p_ist(), 12'345) << kvout_256;
        EXPECT_TRUE(b.motor.in_position()) << kvout_256;
        EXPECT_EQ(b.reg(FNCERR), 0) << kvout_256;
    }
}

TEST(Load, WithoutTorqueNothingMoves) {
    MotorBench b;
    b.set(P_SOLL, 1000);
    b.command(protocol::fastmac::Number::clear_t_soll);
    b.set(MODE_REG, 2);
    b.samples(200);
    EXPECT_EQ(b.motor.p_ist(), 0);
    EXPECT_EQ(b.reg(VF_OUT), 0);
    b.set(T_SOLL, 1023);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 1000);
}

TEST(Load, KvoutZeroGivesNoTorque) {
    MotorBench b;
    b.set(KVOUT, 0);
    b.set(P_SOLL, 1000);
    b.set(MODE_REG, 2);
    b.samples(200);
    EXPECT_EQ(b.motor.p_ist(), 0);
}

TEST(Load, WildRegistersStayInBounds) {
    for (const auto model : {registers::Model::mac140, registers::Model::mac800}) {
        MotorBench b(model);
        b.motor.plant().load() = {.inertia_256 = 0, .friction_torque = -5, .torque = 2'000'000'000};
        b.set(V_SOLL, -2'147'483'647 - 1);
        b.set(A_SOLL, -2'147'483'647 - 1);
        b.set(KVOUT, 2'147'483'647);
        b.set(P_SOLL, 2'147'483'647);
        b.set(T_SOLL, -1);
        for (const int mode : {1, 2, 0, 2, 1}) {
            b.set(MODE_REG, mode);
            b.samples(500);
            EXPECT_LE(std::abs(b.motor.v_ist()), 4097);
        }
    }
}

TEST(Load, ShaftTurnedInInitIsCounted) {
    MotorBench b;
    b.motor.plant().load().torque = 20;
    b.samples(500);
    EXPECT_GT(b.motor.p_ist(), 10);
    EXPECT_EQ(b.reg(FLWERR), 0);
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

// Torque 300 against a spring of 1 of torque a count: 300 counts deep, less the friction of 5 (either way).
// It stays there and comes out without being thrown. The hardest spring leaves 1/129 of the depth: full
// torque, 218 counts/sample^2, over 1000 counts is 660 counts/sample, so (660 + 218) / 129 = 7 counts.
TEST(Load, ASpringyStopGivesWay) {
    Plant soft(3500 / 16.0, 1, {.high_stop = MechanicalStop{1000, 1024}});
    for (int i = 0; i < 2000; ++i) soft.step(300);
    EXPECT_NEAR(static_cast<double>(soft.counts()), 1300, 6);
    for (int i = 0; i < 2000; ++i) soft.step(0);
    EXPECT_LE(soft.counts(), 1010);
    EXPECT_GE(soft.counts(), 980);

    Plant hard(3500 / 16.0, 1, {.low_stop = MechanicalStop{-1000, 1'000'000'000}});
    for (int i = 0; i < 2000; ++i) {
        hard.step(-1023);
        ASSERT_GE(hard.counts(), -1007);
    }
}

}  // namespace
}  // namespace nplc::sim
