#include "sim/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motor_bench.h"
#include "registers/mac.h"

namespace nplc::sim {
namespace {

using registers::Model;

// T / c: 40 / 2 counts a sample of the outer loop, however finely it is computed.
TEST(Axis, ViscousFrictionEndsAtTorqueOverCoefficient) {
    for (const int steps : {1, 15}) {
        Plant shaft(3500 / 16.0, steps, {.friction_torque = 0, .viscous_torque = 2});
        for (int i = 0; i < 2000 * steps; ++i) shaft.step(40);
        EXPECT_NEAR(shaft.velocity() * steps, 20, 1e-6) << steps;
    }
}

// 15 inner samples late is one sample of the outer loop late, to the last bit: torque alone decides.
TEST(Axis, LateTorqueIsTheSameTorqueLater) {
    for (const Servo::Depth depth : {Servo::Depth::current_loop, Servo::Depth::outer_loop}) {
        MotorBench prompt(Model::mac140, {.depth = depth});
        MotorBench late(Model::mac140, {.depth = depth, .load = {.late_inner_samples = 15}});
        for (MotorBench* bench : {&prompt, &late}) {
            bench->set(registers::P_SOLL, 5000);
            bench->set(registers::MODE_REG, 2);
        }
        int first_prompt = 0, first_late = 0;
        for (int i = 1; i < 50; ++i) {
            prompt.samples(1);
            late.samples(1);
            if (first_prompt == 0 && prompt.motor.plant().velocity() > 0) first_prompt = i;
            if (first_late == 0 && late.motor.plant().velocity() > 0) first_late = i;
        }
        EXPECT_GT(first_prompt, 0);
        EXPECT_EQ(first_late, first_prompt + 1);
        EXPECT_LE(late.until_in_position(), 20'000);
    }
}

// What a file's units are must be what the virtual motor is.
TEST(Axis, TheFilesMotorIsTheVirtualOne) {
    for (const Model model : {Model::mac50, Model::mac140, Model::mac800}) {
        const plant_file::Motor motor = plant_file::motor_of(model);
        const MotorConstants& constants = constants_of(model);
        EXPECT_NEAR(motor.sample, constants.outer_period, 1e-9);
        const double acceleration =
            constants.full_acceleration * motor.radians / (motor.sample * motor.sample);  // rad/s^2
        EXPECT_NEAR(motor.full_torque / motor.inertia, acceleration, 1e-6 * acceleration);
    }
    EXPECT_NEAR(plant_file::motor_of(Model::mac140).inertia, 17.3e-6, 0.1e-6);  // 001 3.2.13
}

TEST(Axis, AFilesValuesBecomeALoad) {
    plant_file::Plant plant;
    const plant_file::Motor motor = plant_file::motor_of(Model::mac140);
    plant.inertia = 3 * motor.inertia;
    plant.coulomb_friction = motor.full_torque * 20 / 1023;
    plant.viscous_friction = motor.full_torque * 20 / 1023 / (100 * motor.radians / motor.sample);
    plant.constant_load = -motor.full_torque * 7 / 1023;
    plant.dead_time = motor.current_delay + motor.sample;
    const Load load = load_of(plant, Model::mac140);
    EXPECT_NEAR(load.inertia_256, 3 * 256, 1e-6);
    EXPECT_NEAR(load.friction_torque, 20, 1e-9);
    EXPECT_NEAR(load.viscous_torque, 0.2, 1e-9);  // 20 at 100 counts a sample
    EXPECT_NEAR(load.torque, -7, 1e-9);
    EXPECT_EQ(load.late_inner_samples, 15);
    plant.torque_constant = 0.5;  // half the torque: all of it is twice as much for the motor
    EXPECT_NEAR(load_of(plant, Model::mac140).inertia_256, 6 * 256, 1e-6);
    EXPECT_NEAR(load_of(plant, Model::mac140).torque, -14, 1e-9);
    EXPECT_EQ(load_of({}, Model::mac140).friction_torque, Load{}.friction_torque);
}

TEST(Axis, AFileThatIsNotThereIsNamed) {
    const AxisReading reading = read_axis("/nowhere/axis.toml", Model::mac140);
    EXPECT_TRUE(reading.error.starts_with("/nowhere/axis.toml: cannot be read: ")) << reading.error;
    Scenario scenario;
    scenario.file = "/nowhere/s.scn";
    scenario.plant = NamedPlant{"axis.toml", 3};
    EXPECT_TRUE(
        read_axis({}, scenario, Model::mac140).error.starts_with("/nowhere/s.scn:3: /nowhere/axis.toml: "));
}

}  // namespace
}  // namespace nplc::sim
