#include <cstdlib>
#include <random>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

// 15 samples of the inner loop at 7812.5 Hz: 1.92 ms. MAC800: 1 / 770 s = 1,298,701.3 ns.
TEST(Motor, SamplePeriods) {
    EXPECT_EQ(MacMotor(registers::Model::mac50).sample_period().count(), 1'920'000);
    EXPECT_EQ(MacMotor(registers::Model::mac800).sample_period().count(), 1'298'701);
}

// 001 §3.2.5: V_SOLL 1600 is 1600/16 * 520.8 / 4096 * 60 = 762.9 rpm; §3.2.12: V_IST 100 is the same.
TEST(Motor, VelocityOfTheManual) {
    MotorBench b;
    b.set(V_SOLL, 1600);
    b.set(A_SOLL, 160);
    b.set(MODE_REG, 1);
    b.samples(300);
    const std::int32_t start = b.motor.p_ist();
    b.samples(1000);
    EXPECT_NEAR(b.motor.p_ist() - start, 100'000, 2);
    EXPECT_NEAR(b.motor.v_ist(), 100, 1);  // the encoder's resolution, 001 §3.2.12
    b.motor.write(V_IST, 100);
    EXPECT_NEAR(b.motor.rpm(), 762.9, 0.1);
    EXPECT_EQ(b.reg(FNC_OUT), 1600);
}

// 001 §3.2.6: A_SOLL 160 is 39731 rpm/s. Within one sample of 1.92 ms FNC_OUT grows by 160, and 160 in
// V_SOLL's unit of 0.4768 rpm is 76.29 rpm: 76.29 / 0.00192 = 39734, the manual's figure with its rate cut to
// 520.8.
TEST(Motor, AccelerationOfTheManual) {
    MotorBench b;
    b.set(V_SOLL, 1600);
    b.set(A_SOLL, 160);
    b.set(MODE_REG, 1);
    for (int n = 1; n <= 10; ++n) {
        b.samples(1);
        EXPECT_EQ(b.reg(FNC_OUT), 160 * n);
        EXPECT_NE(b.motor.err_stat() & err::ACC_FLAG, 0U);
    }
    b.samples(1);
    EXPECT_EQ(b.motor.err_stat() & (err::ACC_FLAG | err::DEC_FLAG), 0U);
    EXPECT_NEAR(160.0 / 16 * 520.8 * 520.8 / 4096 * 60, 39731, 1.0);
    const double rpm_per_second = 160.0 / 16 / 4096 * 60 / (0.00192 * 0.00192);
    EXPECT_NEAR(rpm_per_second, 39731 * (520.8333 / 520.8) * (520.8333 / 520.8), 1.0);
}

// 004: 1000 rpm is 2771 in 1/16 counts/sample; V_IST = 173.16.
TEST(Motor, VelocityOfTheMac800) {
    MotorBench b(registers::Model::mac800);
    b.set(V_SOLL, 2771);
    b.set(MODE_REG, 1);
    b.samples(400);
    const std::int32_t start = b.motor.p_ist();
    b.samples(1600);
    EXPECT_NEAR(b.motor.p_ist() - start, 2771 * 100, 2);
    EXPECT_NEAR(b.reg(11), 2771, 16);  // V_IST_16
    b.motor.write(V_IST, 173);
    EXPECT_NEAR(b.motor.rpm(), 173 / 0.17316, 0.1);
}

// README of mac_motor: the way from P_FNC to P_IST has poles at 0.31 and 0.085 (0.45 and 0.09 samples)
// and 1.62 samples of its own, so 2.16 samples of 100 counts.
TEST(Motor, FollowsWithALagThatReturnsToZero) {
    MotorBench b;
    b.set(P_SOLL, 40960);
    b.set(MODE_REG, 2);
    std::int32_t most = 0;
    for (int i = 0; i < 600; ++i) {
        b.samples(1);
        most = std::max(most, std::abs(b.reg(FLWERR)));
        // FLWERR is P_FNC less the shaft's position, in counts.
        ASSERT_LE(std::abs(b.reg(P_FNC) / 16 - b.reg(FLWERR) - b.motor.p_ist()), 1);
    }
    EXPECT_NEAR(most, 216, 10);
    EXPECT_EQ(b.motor.p_ist(), 40960);
    EXPECT_EQ(b.reg(FLWERR), 0);
    EXPECT_EQ(b.reg(P_FNC), 16 * 40960);
    EXPECT_EQ(b.motor.v_ist(), 0);
    EXPECT_EQ(b.reg(FNCERR), 0);
}

void random_moves(registers::Model model, unsigned seed) {
    std::mt19937 random(seed);
    MotorBench b(model);
    b.set(MODE_REG, 2);
    for (int move = 0; move < 60; ++move) {
        const auto v = static_cast<std::int32_t>(random() % 3000 + 200);
        const auto a = static_cast<std::int32_t>(random() % 800 + 5);
        const std::int32_t target = static_cast<std::int32_t>(random() % 100'000) - 50'000;
        b.set(V_SOLL, random() % 2 == 0 ? v : -v);
        b.set(A_SOLL, a);
        b.set(P_SOLL, target);
        const bool forward = target >= b.motor.p_ist();
        std::int32_t v_old = 0;
        for (int sample = 0; sample < 12'000; ++sample) {
            const std::int32_t p_before = b.reg(P_FNC);
            b.samples(1);
            const std::int32_t velocity = b.reg(P_FNC) - p_before;
            ASSERT_LE(std::abs(velocity), v) << "seed " << seed << " move " << move;
            ASSERT_LE(std::abs(velocity - v_old), a) << "seed " << seed << " move " << move;
            ASSERT_TRUE(forward ? velocity >= 0 : velocity <= 0) << "seed " << seed << " move " << move;
            v_old = velocity;
            if (b.reg(P_FNC) == 16 * target) break;
        }
        ASSERT_EQ(b.reg(P_FNC), 16 * target) << "seed " << seed << " move " << move;
        b.settle();
        ASSERT_EQ(b.motor.p_ist(), target) << "seed " << seed << " move " << move;
        ASSERT_TRUE(b.motor.in_position()) << "seed " << seed << " move " << move;
        ASSERT_EQ(b.reg(FNCERR), 0) << "seed " << seed << " move " << move;
    }
}

TEST(Motor, RandomMovesEndOnTheTarget) {
    random_moves(registers::Model::mac140, 7);
}

TEST(Motor, RandomMovesEndOnTheTargetMac800) {
    random_moves(registers::Model::mac800, 8);
}

// 32 of V_SOLL's units are two counts/sample: V_IST's resolution and one count of ripple.
TEST(Motor, DefaultWindowHoldsAtAnyVelocity) {
    for (const auto model : {registers::Model::mac140, registers::Model::mac800}) {
        for (int v = 100; v < 3300; v += 237) {
            MotorBench b(model);
            b.set(V_SOLL, v);
            b.set(MODE_REG, 1);
            b.samples(500);
            for (int i = 0; i < 300; ++i) {
                b.samples(1);
                ASSERT_TRUE(b.motor.in_position()) << "V_SOLL " << v;
            }
        }
    }
}

TEST(Motor, NegativeVelocityIsALimitToo) {
    MotorBench b;
    b.set(V_SOLL, -800);
    b.set(P_SOLL, 5000);
    b.set(MODE_REG, 2);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 5000);
}

TEST(Motor, TargetChangedInMidMoveAndReversed) {
    MotorBench b;
    b.set(P_SOLL, 100'000);
    b.set(MODE_REG, 2);
    b.samples(100);
    EXPECT_GT(b.motor.v_ist(), 90);
    b.set(P_SOLL, -2000);
    b.samples(1);
    EXPECT_NE(b.motor.err_stat() & err::DEC_FLAG, 0U);
    EXPECT_FALSE(b.motor.in_position());
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), -2000);
    b.set(P_SOLL, 9000);
    b.samples(5);
    b.set(P_SOLL, 9001);
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 9001);
}

// 001 §4.4.3 and §3.2.33: in position only below INPOSWIN, and only after INPOSCNT samples in a row.
TEST(Motor, InPositionIsStrictlyLessAndCounted) {
    MotorBench b;
    b.set(MODE_REG, 2);
    b.set(INPOSWIN, 10);
    b.set(INPOSCNT, 4);
    b.set(V_SOLL, 0);  // stands where it is; only the distance to P_SOLL differs
    b.set(P_SOLL, 10);
    b.samples(20);
    EXPECT_FALSE(b.motor.in_position());
    b.set(P_SOLL, -9);
    b.samples(3);
    EXPECT_FALSE(b.motor.in_position());
    b.samples(1);
    EXPECT_TRUE(b.motor.in_position());
    b.set(P_SOLL, -10);
    b.samples(1);
    EXPECT_FALSE(b.motor.in_position());
    b.set(P_SOLL, 9);
    b.samples(3);
    EXPECT_FALSE(b.motor.in_position());
    b.set(P_SOLL, 10);
    b.samples(1);
    b.set(P_SOLL, 9);
    b.samples(3);
    EXPECT_FALSE(b.motor.in_position()) << "the count begins anew";
    b.samples(1);
    EXPECT_TRUE(b.motor.in_position());
    b.set(INPOSCNT, 0);
    b.set(P_SOLL, 20);
    b.samples(1);
    b.set(P_SOLL, 0);
    b.samples(1);
    EXPECT_TRUE(b.motor.in_position());
}

// 001 §4.1.1: |V_SOLL - 16 V_IST| < INPOSWIN, or with INPOSCNT 0 |V_IST| < INPOSWIN (the motor stands).
TEST(Motor, InPositionInVelocityMode) {
    MotorBench b;
    b.set(V_SOLL, 1600);
    b.set(INPOSWIN, 40);
    b.set(INPOSCNT, 3);
    b.set(MODE_REG, 1);
    b.samples(5);
    EXPECT_FALSE(b.motor.in_position());
    b.samples(300);
    EXPECT_TRUE(b.motor.in_position());
    b.set(INPOSCNT, 0);
    b.samples(1);
    EXPECT_FALSE(b.motor.in_position());
    b.set(V_SOLL, 0);
    b.samples(300);
    EXPECT_TRUE(b.motor.in_position());
}

// 001 §4.1.2: 100000 counts by P_SOLL end with P_FNC = 1600000; by P_FNC - 1600000 they end with P_FNC = 0,
// and that can be repeated for ever.
TEST(Motor, RelativeMovesBothWays) {
    MotorBench b;
    b.set(P1, 100'000);
    b.set(V_SOLL, 4000);
    b.set(MODE_REG, 2);
    b.command(0x75);  // relative by P_SOLL
    b.command(0x40);  // P1
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.reg(P_SOLL), 100'000);
    EXPECT_EQ(b.reg(P_FNC), 1'600'000);
    EXPECT_EQ(b.motor.p_ist(), 100'000);
    b.command(protocol::fastmac::Number::clear_p_soll);
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 0);
    b.command(0x76);  // relative by P_FNC
    for (int n = 1; n <= 3; ++n) {
        b.command(0x40);
        EXPECT_FALSE(b.motor.in_position());
        b.until_in_position();
        b.settle();
        EXPECT_EQ(b.reg(P_FNC), 0);
        EXPECT_EQ(b.reg(P_SOLL), 0);
        EXPECT_EQ(b.motor.p_ist(), 100'000 * n);
    }
}

// 670 moves of 100000 pass P_SOLL's range of 67E6 (001 §4.1.2); by P_FNC the range is never left, and P_IST
// wraps.
TEST(Motor, TurntableGoesOnForEver) {
    MotorBench b;
    b.set(P1, 67'000'000);
    b.set(V_SOLL, 10'000);  // 4768 rpm
    b.set(A_SOLL, 1000);
    b.set(T1, 1023);
    b.set(P_IST, 2'147'483'000);
    b.set(MODE_REG, 2);
    b.command(0x76);
    b.command(0x40);
    b.samples(108'000);  // 67E6 / 625 = 107200
    EXPECT_EQ(b.reg(P_FNC), 0);
    EXPECT_EQ(b.motor.p_ist(), -2'147'483'648 + (67'000'000 - 648));
    EXPECT_TRUE(b.motor.in_position());
}

TEST(Motor, ZeroAccelerationNeverMoves) {
    MotorBench b;
    b.set(A_SOLL, 0);
    b.set(P_SOLL, 1000);
    b.set(MODE_REG, 2);
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 0);
    EXPECT_EQ(b.reg(P_FNC), 0);
}

TEST(Motor, SameCallsSameMotion) {
    const auto run = [] {
        MotorBench b;
        b.set(P_SOLL, 30'000);
        b.set(MODE_REG, 2);
        std::vector<std::int32_t> trace;
        for (int i = 0; i < 500; ++i) {
            b.samples(1);
            trace.push_back(b.motor.p_ist());
        }
        return trace;
    };
    EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace nplc::sim
