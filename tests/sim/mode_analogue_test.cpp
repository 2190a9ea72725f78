// The modes that the analogue input steers, with numbers of 001 §4.1 and §4.4.
#include "sim/profile_blocks.h"

#include <cstdlib>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
constexpr registers::Model kSmall = registers::Model::mac140;
constexpr registers::Model kBig = registers::Model::mac800;

// 001 §4.1.5: 10 V (1023) is V_SOLL. 511 x 1600 / 1023 = 799.2.
TEST(AnalogueBlocks, Velocity) {
    EXPECT_EQ(analogue_velocity(kSmall, 1023, 1600), 1600);
    EXPECT_EQ(analogue_velocity(kSmall, -1023, 1600), -1600);
    EXPECT_EQ(analogue_velocity(kSmall, 511, 1600), 799);
    EXPECT_EQ(analogue_velocity(kSmall, -511, -1600), 799);
    EXPECT_EQ(analogue_velocity(kSmall, 20'000, 1600), 1600) << "R: an offset does not go beyond V_SOLL";
    EXPECT_EQ(analogue_velocity(kBig, 2048, 1600), 1600);
    EXPECT_EQ(analogue_velocity(kBig, 1024, 1600), 800);
}

// 001 §4.1.6: (1023 - 64) x 0.0010416 x 1600 = 1598.2; at 65 it is 0.0010416 x 16000 = 16.7; at -64, where
// the manual has <=, (-64 + 64) = 0. MAC800: (2048 - 128) x 0.0005208 x 1600 = 1599.9.
TEST(AnalogueBlocks, DeadBand) {
    const auto w = [](std::int32_t aninp, std::int32_t v_soll) {
        return analogue_velocity_with_dead_band(kSmall, aninp, v_soll);
    };
    EXPECT_EQ(w(1023, 1600), 1598);
    EXPECT_EQ(w(-1023, 1600), -1598);
    EXPECT_EQ(w(65, 16'000), 16);
    EXPECT_EQ(w(-65, 16'000), -16);
    for (const std::int32_t aninp : {64, 1, 0, -1, -63, -64}) EXPECT_EQ(w(aninp, 16'000), 0) << aninp;
    EXPECT_EQ(analogue_velocity_with_dead_band(kBig, 2048, 1600), 1599);
    EXPECT_EQ(analogue_velocity_with_dead_band(kBig, 128, 16'000), 0);
    EXPECT_EQ(analogue_velocity_with_dead_band(kBig, 130, 16'000), 16);
}

// 001 §4.1.7: 10 V are 300 rpm. V_SOLL 1600 are 762.9 rpm (§3.2.5), so 300 rpm are 629.1; MAC800 (004): 300 x
// 2.77056 = 831.2.
TEST(AnalogueBlocks, Trim) {
    EXPECT_EQ(analogue_trim(kSmall, 1023), 629);
    EXPECT_EQ(analogue_trim(kSmall, -1023), -629);
    EXPECT_EQ(analogue_trim(kSmall, 511), 314);
    EXPECT_EQ(analogue_trim(kBig, 2048), 831);
}

// 001 §4.4.18: |1023 x 500 / 1024| = 499.5.
TEST(AnalogueBlocks, TorqueLimit) {
    EXPECT_EQ(analogue_torque_limit(kSmall, 1023, 500), 499);
    EXPECT_EQ(analogue_torque_limit(kSmall, -512, 1000), 500);
    EXPECT_EQ(analogue_torque_limit(kSmall, 0, 1023), 0);
    EXPECT_EQ(analogue_torque_limit(kBig, 1024, 1000), 500);
}

// 001 §4.1.9: 1.15 at 10 V, 0.87 at -10 V (1 / 1.15 = 0.869565), 1 at 0 V; R: a power between, so 5 V (511.5)
// are 1.0724 = sqrt(1.15).
TEST(AnalogueBlocks, GearFactor) {
    EXPECT_EQ(analogue_gear_factor(kSmall, 0), 65'536);
    EXPECT_EQ(analogue_gear_factor(kSmall, 1023), 75'366);   // 1.15 x 65536 = 75366.4
    EXPECT_EQ(analogue_gear_factor(kSmall, -1023), 56'988);  // 56987.8
    EXPECT_NEAR(analogue_gear_factor(kSmall, 512), 70'279, 6);
    EXPECT_EQ(analogue_gear_factor(kBig, 2048), 75'366);
    EXPECT_EQ(analogue_gear_factor(kBig, 1024), 70'280);  // sqrt(1.15) x 65536 = 70279.6
}

// 001 §4.1.11. P2 = 160, P1 = 1000: 10 V (1023) ask for 11,230. P3 = 50 is the band.
TEST(AnalogueBlocks, PositionWithDeadBand) {
    const auto p_soll = [](std::int32_t aninp, std::int32_t old) {
        return analogue_position(aninp, 1000, 160, 50, old);
    };
    EXPECT_EQ(p_soll(1023, 0), 11'180) << "upwards it stays the band below";
    EXPECT_EQ(p_soll(1028, 11'180), 11'230) << "11,280 - 50";
    EXPECT_EQ(p_soll(1020, 11'180), 11'180) << "11,200 is above, but within the band";
    EXPECT_EQ(p_soll(1015, 11'180), 11'180) << "11,150 + 50 is not below";
    EXPECT_EQ(p_soll(1000, 11'180), 11'050) << "downwards it stays the band above: 11,000 + 50";
    EXPECT_EQ(p_soll(0, 1000), 1000);
}

struct Analogue : ::testing::Test {
    static MotorBench in(int mode, int millivolts, registers::Model model = kSmall) {
        MotorBench b(model);
        b.motor.terminals().set_analogue(millivolts);
        b.samples(1);
        b.set(MODE_REG, mode);
        return b;
    }
};

// 001 §4.4.6: 5 V are 511; FNC_OUT 799 = 16 x 49.9. FLWERR adds up, FNCERR and IN_POS are 0.
TEST_F(Analogue, AvRunsAtTheVoltagesShare) {
    MotorBench b = in(5, 5'000);
    b.samples(1);
    EXPECT_EQ(b.reg(FNC_OUT), 160) << "A_SOLL";
    b.samples(2);
    EXPECT_GT(b.reg(FLWERR), 0);
    b.samples(97);
    EXPECT_EQ(b.reg(FNC_OUT), 799);
    EXPECT_NEAR(b.motor.v_ist(), 50, 1);
    EXPECT_EQ(b.reg(FNCERR), 0);
    EXPECT_FALSE(b.motor.in_position());
    b.motor.terminals().set_analogue(-10'000);
    b.samples(100);
    EXPECT_EQ(b.reg(FNC_OUT), -1600);
}

// 0.6 V is 61, within the band; 1 V is 102: 38 x 0.0010416 x 1600 = 63.3.
TEST_F(Analogue, AvzStandsInItsBand) {
    MotorBench b = in(16, 600);
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 0);
    b.motor.terminals().set_analogue(1'000);
    b.samples(100);
    EXPECT_EQ(b.reg(FNC_OUT), 63);
    b.motor.terminals().set_analogue(10'000);
    b.samples(100);
    EXPECT_EQ(b.reg(FNC_OUT), 1598);
    EXPECT_FALSE(b.motor.in_position());
}

// 001 §4.4.5: torque = ANINP's share of T_SOLL, no speed regulator: 2 V (204) of 200 are 39.
TEST_F(Analogue, AtGivesTorque) {
    MotorBench b = in(4, 2'000);
    b.set(T_SOLL, 200);
    b.samples(2);
    EXPECT_EQ(b.reg(VF_OUT), 39);
    b.samples(10);
    EXPECT_GT(b.motor.v_ist(), 50);
    EXPECT_EQ(b.reg(FLWERR), 0);
    EXPECT_EQ(b.reg(FNC_OUT), 0);
    EXPECT_FALSE(b.motor.in_position());
}

// 001 §4.4.5: torque 0, wait for low speed (R: 300 rpm, as STOP has it: 39 counts/sample), INIT.
TEST_F(Analogue, AtLeavesOnlyForInitAndWithoutTorque) {
    MotorBench b = in(4, 2'000);
    b.samples(40);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 4);
    int last = b.motor.v_ist();
    while (b.reg(MODE_REG) == 4) {
        b.samples(1);
        ASSERT_EQ(b.reg(VF_OUT), 0);
        ASSERT_GT(b.reg(MODE_REG) == 0 ? 40 : 10'000, b.motor.v_ist());
        if (b.reg(MODE_REG) == 4) last = b.motor.v_ist();
    }
    EXPECT_GE(last, 40) << "it waited";
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 2);
}

// 001 §4.4.18: velocity mode with the limit |511 x 300 / 1024| = 149 at 5 V; the load takes all of it.
TEST_F(Analogue, VatLimitsTheTorque) {
    MotorBench b = in(17, -5'000);
    b.set(T_SOLL, 300);
    b.motor.plant().load().torque = -600;
    b.samples(20);
    EXPECT_EQ(b.reg(VF_OUT), 149);
    b.motor.plant().load().torque = 0;
    b.samples(500);
    EXPECT_EQ(b.reg(FNC_OUT), 1600) << "V_SOLL, whatever the voltage";
    EXPECT_TRUE(b.motor.in_position()) << "as velocity mode has it";
}

// 001 §4.4.7. Without pulses 10 V turn the motor at 300 rpm: 831 / 16 = 51.9 counts/sample. FNCERR 0, IN_POS
// 0.
TEST_F(Analogue, AvgAddsTheVoltageToThePulses) {
    MotorBench b = in(6, 10'000, kBig);
    b.set(V_SOLL, 8000);
    b.samples(300);
    EXPECT_EQ(b.reg(166) / 0x10000, 831);
    EXPECT_NEAR(b.motor.rpm(), 300, 15);
    b.motor.terminals().set_pulse_rate(77'000);  // 100 a sample: 1600 + 831
    b.samples(300);
    EXPECT_EQ(b.reg(166) / 0x10000, 2431);
    EXPECT_EQ(b.reg(FNCERR), 0);
    EXPECT_FALSE(b.motor.in_position());
    b.set(V_SOLL, 1000);  // 001 §3.2.5: the total maximum
    b.samples(100);
    EXPECT_EQ(b.reg(166) / 0x10000, 1000);
}

// 001 §4.1.9: 100 pulses a sample x 2 / 1 x 1.15 = 230 counts/sample; at 0 V 200; without pulses it stands.
TEST_F(Analogue, AgChangesTheGearFactor) {
    MotorBench b = in(18, 10'000, kBig);
    b.set(V_SOLL, 8000);
    b.set(14, 2);
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 0) << "whatever the voltage";
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(400);
    EXPECT_NEAR(b.reg(166) / 0x10000, 16 * 230, 1);
    b.motor.terminals().set_analogue(0);
    b.samples(600);
    EXPECT_NEAR(b.reg(166) / 0x10000, 16 * 200, 1);
    b.motor.terminals().set_analogue(-10'000);
    b.samples(600);
    EXPECT_NEAR(b.reg(166) / 0x10000, 16 * 173.9, 1);
}

MotorBench two_positions(int mode_bits) {
    MotorBench b;
    b.set(P1, 1000);
    b.set(P1 + 2, 4000);
    b.set(ERR_STAT, mode_bits);
    b.set(MODE_REG, 20);
    b.samples(5);
    EXPECT_EQ(b.reg(P_SOLL), 0) << "nothing before a change of the level";
    return b;
}

void turn(MotorBench& b, int millivolts) {
    b.motor.terminals().set_analogue(millivolts);
    b.samples(300);
}

// 001 §4.1.10: high above 5.4 V (552.4 of 1023), low below 4.4 V (450.1).
TEST(A2Pos, AbsoluteWithHysteresis) {
    MotorBench b = two_positions(0);
    turn(b, 5'390);
    EXPECT_EQ(b.motor.p_ist(), 0);
    turn(b, 5'420);
    EXPECT_EQ(b.reg(P_SOLL), 4000);
    EXPECT_EQ(b.motor.p_ist(), 4000);
    EXPECT_TRUE(b.motor.in_position());
    turn(b, 4'420);
    EXPECT_EQ(b.reg(P_SOLL), 4000);
    turn(b, 4'380);
    EXPECT_EQ(b.reg(P_SOLL), 1000);
    EXPECT_EQ(b.motor.p_ist(), 1000);
}

TEST(A2Pos, RelativeByPSoll) {
    MotorBench b = two_positions(1 << 9);
    turn(b, 10'000);
    turn(b, 0);
    turn(b, 10'000);
    EXPECT_EQ(b.reg(P_SOLL), 4000 + 1000 + 4000);
    EXPECT_EQ(b.motor.p_ist(), 9000);
}

// P_SOLL stays: the motor goes P2, P1, P2 counts on. R: 16 x P2 off P_FNC, so P_FNC ends at P_SOLL = 0.
TEST(A2Pos, RelativeByPFnc) {
    MotorBench b = two_positions(1 << 10);
    turn(b, 10'000);
    EXPECT_EQ(b.motor.p_ist(), 4000);
    turn(b, 0);
    turn(b, 10'000);
    EXPECT_EQ(b.reg(P_SOLL), 0);
    EXPECT_EQ(b.reg(P_FNC), 0);
    EXPECT_EQ(b.motor.p_ist(), 9000);
}

TEST(A2Pos, FunctionCorrectionCounts) {
    MotorBench b = two_positions(0);
    b.set(T_SOLL, 200);
    b.motor.plant().load().high_stop = MechanicalStop{3000};
    turn(b, 10'000);
    EXPECT_LT(b.reg(FNCERR), 0);
    EXPECT_LE(std::abs(b.reg(FLWERR)), 2000) << "limited by the correction (§3.2.20)";
}

// 001 §4.1.11: 5 V (511) x 160 / 16 + 1000 = 6110, less the band of 50.
TEST(APos, FollowsTheVoltage) {
    MotorBench b;
    b.set(P1, 1000);
    b.set(P1 + 2, 160);
    b.set(P1 + 4, 50);
    b.motor.terminals().set_analogue(5'000);
    b.set(MODE_REG, 21);
    b.samples(300);
    EXPECT_EQ(b.reg(P_SOLL), 6060);
    EXPECT_EQ(b.motor.p_ist(), 6060);
    EXPECT_TRUE(b.motor.in_position());
    turn(b, 4'960);  // 507: 6070, within the band
    EXPECT_EQ(b.reg(P_SOLL), 6060);
    turn(b, 0);
    EXPECT_EQ(b.reg(P_SOLL), 1050);
    EXPECT_EQ(b.motor.p_ist(), 1050);
}

}  // namespace
}  // namespace nplc::sim
