#include "plant_file/plant_file.h"

#include <gtest/gtest.h>

namespace nplc::plant_file {
namespace {

constexpr const char* kWhole = R"(# of a lift
motor = "MAC140"

[plant]
inertia = 4.21e-05
coulomb_friction = 0.0312
viscous_friction = 0.00012
constant_load = -0.11
dead_time = 0.00045
torque_constant = 0.97

[fit]
r2_velocity = 0.9993
)";

TEST(PlantFile, IsReadWhole) {
    const Reading reading = read_plant(kWhole, "axis.toml");
    ASSERT_EQ(reading.error, "");
    EXPECT_EQ(reading.plant.motor, "MAC140");
    EXPECT_EQ(reading.plant.inertia, 4.21e-05);
    EXPECT_EQ(reading.plant.coulomb_friction, 0.0312);
    EXPECT_EQ(reading.plant.viscous_friction, 0.00012);
    EXPECT_EQ(reading.plant.constant_load, -0.11);
    EXPECT_EQ(reading.plant.dead_time, 0.00045);
    EXPECT_EQ(reading.plant.torque_constant, 0.97);
}

TEST(PlantFile, WhatIsLeftOutIsNotThere) {
    const Reading reading = read_plant("[plant]\ninertia = 1e-4\n", "axis.toml");
    ASSERT_EQ(reading.error, "");
    EXPECT_TRUE(reading.plant.inertia);
    EXPECT_FALSE(reading.plant.coulomb_friction);
    EXPECT_EQ(mismatch(reading.plant, registers::Model::mac800), "");
}

TEST(PlantFile, MistakesAreToldWithTheirLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "f:1: there is no [plant] in it"},
        {"[plant]\n\nmass = 1", "f:3: 'mass' is no part of a plant; there are inertia, coulomb_friction, "},
        {"[plant]\ninertia = \"much\"", "f:2: inertia is a number in kg m2; write such as inertia = 0.01"},
        {"[plant]\ninertia = 0", "f:2: inertia = 0 kg m2 is not within 1e-07 to 1; "},
        {"[plant]\nconstant_load = nan", "f:2: constant_load = nan N m is not within -100 to 100; "},
        {"[plant]\ndead_time = inf", "f:2: dead_time = inf s is not within 0 to 0.01; "},
        {"motor = \"MAC34-1\"\n[plant]", "f:1: motor: write \"MAC50\""},
        {"motor = 140\n[plant]", "f:1: motor: write \"MAC50\""},
        {"plant = 3", "f:1: 'plant' is a table; write [plant]"},
        {"[plnt]\ninertia = 1", "f:1: 'plnt' is not known here; write motor and [plant]"},
        {"\"a\\nb\" = 1", "f:1: 'a?b' is not known here"},
        {"[plant]\ninertia = = 1", "f:2: this is not TOML: "},
    };
    for (const auto& [text, said] : cases) {
        const Reading reading = read_plant(text, "f");
        EXPECT_TRUE(reading.error.starts_with(said)) << reading.error;
        EXPECT_FALSE(reading.plant.inertia);
    }
}

TEST(PlantFile, IsOfOneMotor) {
    using registers::Model;
    EXPECT_EQ(mismatch({.motor = "MAC140"}, Model::mac140), "");
    EXPECT_NE(mismatch({.motor = "MAC140"}, Model::mac95), "");
    EXPECT_EQ(mismatch({.motor = "MAC50-141"}, Model::mac95), "");
    EXPECT_TRUE(mismatch({.motor = "MAC50-141"}, Model::mac800)
                    .starts_with("this plant is of a MAC50-141 and the simulated motor is a MAC800; "));
}

}  // namespace
}  // namespace nplc::plant_file
