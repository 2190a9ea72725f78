#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "driver.h"
#include "sim/mac_motor.h"
#include "sim/motor_stage.h"

/// A motor whose registers a host writes, in the FMU and as it is.
namespace nplc::sim::fmu {
namespace {

struct Write {
    int sample;
    Id input;
    std::uint8_t reg;
    std::int32_t value;
};

const std::vector<Write> kWrites = {
    {0, Id::v_soll, registers::V_SOLL, 1500},   {0, Id::a_soll, registers::A_SOLL, 120},
    {5, Id::p_soll, registers::P_SOLL, 60'000}, {5, Id::mode_reg, registers::MODE_REG, 2},
    {400, Id::t_soll, registers::T_SOLL, 700},  {900, Id::mode_reg, registers::MODE_REG, 1},
    {1100, Id::v_soll, registers::V_SOLL, -900}};

class FmuMotor : public ::testing::TestWithParam<registers::Model> {};

TEST_P(FmuMotor, IsTheVirtualMotor) {
    const FmuOptions options = options_of("", GetParam());
    const UnpackedFmu fmu(packed(options));
    Fmu3 one(fmu);
    MacMotor motor(GetParam());
    const double turn = 2 * std::numbers::pi / motor.counts_per_revolution();
    const double period = static_cast<double>(motor.sample_period().count()) / 1e9;
    one.start();
    for (int sample = 0; sample < 1400; ++sample) {
        for (const Write& write : kWrites) {
            if (write.sample != sample) continue;
            ASSERT_EQ(one.set(write.input, write.value), fmi3OK) << one.last_message();
            motor.write(write.reg, write.value);
        }
        if (sample == 700) {
            const double torque = 0.3 * full_torque(GetParam());
            ASSERT_EQ(one.set(Id::load_torque, torque), fmi3OK);
            motor.plant().load().torque = static_cast<int>(std::lround(0.3 * 1023));
        }
        motor.sample();
        ASSERT_EQ(one.step(period), fmi3OK) << one.last_message();
        ASSERT_EQ(one.integer(Id::p_ist), motor.p_ist()) << sample;
        ASSERT_EQ(one.integer(Id::v_ist), motor.v_ist()) << sample;
        ASSERT_EQ(one.bits(Id::err_stat), motor.err_stat()) << sample;
        ASSERT_EQ(one.integer(Id::mode), motor.mode()) << sample;
        ASSERT_EQ(one.truth(Id::in_pos), motor.in_position()) << sample;
        ASSERT_EQ(one.real(Id::position), motor.plant().position() * turn) << sample;
        ASSERT_EQ(one.real(Id::torque), motor.torque() * full_torque(GetParam()) / 1023) << sample;
    }
    EXPECT_GT(std::abs(one.integer(Id::p_ist)), 10'000);
}

/// The values of a plant file go through resources/machine.txt to the last bit, also where no parameter has
/// their steps.
TEST_P(FmuMotor, HasThePlantOfAFile) {
    FmuOptions options = options_of("", GetParam());
    const Load load{.inertia_256 = 700.123,
                    .friction_torque = 12.345,
                    .torque = -30.7,
                    .viscous_torque = 0.0321,
                    .late_inner_samples = 11};
    options.setup.plant = load;
    const UnpackedFmu fmu(packed(options));
    Fmu3 one(fmu);
    MacMotor motor(GetParam(), {.load = load});
    one.start();
    for (const auto& [input, reg, value] : {std::tuple{Id::p_soll, registers::P_SOLL, 9000},
                                            std::tuple{Id::mode_reg, registers::MODE_REG, 2}}) {
        ASSERT_EQ(one.set(input, value), fmi3OK);
        motor.write(reg, value);
    }
    const double period = static_cast<double>(motor.sample_period().count()) / 1e9;
    for (int sample = 0; sample < 600; ++sample) {
        if (sample == 300) {
            ASSERT_EQ(one.set(Id::load_torque, 0.1 * full_torque(GetParam())), fmi3OK);
            motor.plant().load().torque = load.torque + 102;  // 0.1 x 1023
        }
        motor.sample();
        ASSERT_EQ(one.step(period), fmi3OK) << one.last_message();
        ASSERT_EQ(one.integer(Id::p_ist), motor.p_ist()) << sample;
        ASSERT_EQ(one.real(Id::torque), motor.torque() * full_torque(GetParam()) / 1023) << sample;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, FmuMotor,
                         ::testing::Values(registers::Model::mac50, registers::Model::mac140,
                                           registers::Model::mac800));

/// 1.92 ms are a sample: what is no multiple waits for the next step and is not lost.
TEST(FmuMotorSteps, ThatAreNoMultiplesDoWhatIsDueAndLeaveTheRest) {
    const UnpackedFmu fmu(packed(options_of("")));
    Fmu3 one(fmu);
    one.start();
    ASSERT_EQ(one.set(Id::p_soll, 20'000), fmi3OK);
    ASSERT_EQ(one.set(Id::mode_reg, 2), fmi3OK);
    MacMotor motor(registers::Model::mac140);
    motor.write(registers::P_SOLL, 20'000);
    motor.write(registers::MODE_REG, 2);
    std::int64_t samples = 0;
    for (int step = 1; step <= 3000; ++step) {
        ASSERT_EQ(one.step(0.7e-3), fmi3OK);
        for (; samples < step * 700'000LL / 1'920'000; ++samples) motor.sample();
        ASSERT_EQ(one.integer(Id::p_ist), motor.p_ist()) << step;
    }
    EXPECT_EQ(samples, 1093);  // 2.1 s
    EXPECT_GT(motor.p_ist(), 15'000);
}

/// The speed in rad/s is that of the position's course.
TEST(FmuMotorShaft, TurnsWithItsVelocity) {
    const UnpackedFmu fmu(packed(options_of("")));
    Fmu3 one(fmu);
    one.start();
    ASSERT_EQ(one.set(Id::v_soll, 1000), fmi3OK);
    ASSERT_EQ(one.set(Id::mode_reg, 1), fmi3OK);
    ASSERT_EQ(one.step(1.92), fmi3OK);
    const double before = one.real(Id::position);
    ASSERT_EQ(one.step(0.96), fmi3OK);
    // 1000/16 counts a sample are 62.5 x 2 pi / 4096 / 1.92 ms = 49.93 rad/s
    EXPECT_NEAR((one.real(Id::position) - before) / 0.96, 49.93, 0.1);
    EXPECT_NEAR(one.real(Id::velocity), 49.93, 1.0);
}

/// 0.1 N.m on 500E-6 kgm2 and the motor's own 17.2E-6: 193.4 rad/s2, 0.743 rad/s after 3.84 ms. The passive
/// motor's windings are shorted and brake the faster one.
TEST(FmuMotorLoad, InertiaSlowsAndStopsHold) {
    const UnpackedFmu fmu(packed(options_of("")));
    const auto turned = [&fmu](double inertia) {
        Fmu3 one(fmu);
        EXPECT_EQ(one.set(Id::load_inertia, inertia), fmi3OK) << one.last_message();
        EXPECT_EQ(one.set(Id::friction_torque, 0.0), fmi3OK);
        EXPECT_EQ(one.set(Id::load_torque, 0.1), fmi3OK);
        one.start();
        EXPECT_EQ(one.step(3.84e-3), fmi3OK);
        return one.real(Id::velocity);
    };
    EXPECT_NEAR(turned(500e-6), 0.743, 0.1);
    EXPECT_GT(turned(0), 5);

    Fmu3 one(fmu);
    EXPECT_EQ(one.set(Id::has_high_stop, true), fmi3OK);
    EXPECT_EQ(one.set(Id::high_stop, 3.0), fmi3OK);
    EXPECT_EQ(one.set(Id::load_torque, 1.0), fmi3OK);
    one.start();
    ASSERT_EQ(one.step(2), fmi3OK);
    EXPECT_NEAR(one.real(Id::position), 3.0, 0.002);
    EXPECT_EQ(one.real(Id::velocity), 0);
    EXPECT_EQ(one.set(Id::high_stop, 4.0), fmi3Error);
    EXPECT_NE(one.last_message().find("fixed parameter"), std::string::npos) << one.last_message();
}

}  // namespace
}  // namespace nplc::sim::fmu
