#include "macreg/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hidden_axis.h"
#include "macreg/axis_file.h"
#include "plant_file/plant_file.h"

/// What cannot be determined from recordings is named; what can becomes a file.
namespace nplc::macreg {
namespace {

using hidden::Axis;
using registers::Model;

Series series_in(const Recording& recording) {
    SeriesReading reading = series_of(recording, "hidden.csv");
    EXPECT_EQ(reading.error, "");
    return reading.series;
}

bool says(const Estimate& estimate, std::string_view part) {
    return !estimate.told && estimate.why.find(part) != std::string::npos;
}

/// There and back, fast and slow.
std::vector<Series> whole(const Axis& axis, std::uint64_t seed) {
    hidden::Bench bench(axis, seed);
    static_cast<void>(bench.record({{0, 0, 10}}, 500));
    std::vector<Series> all;
    all.push_back(series_in(bench.record({{20, 20000, 100}, {460, 0, 100}})));
    all.push_back(series_in(bench.record({{20, 6000, 25}, {460, 0, 25}})));
    return all;
}

TEST(Fit, WithoutReversalFrictionAndLoadAreNotToldApart) {
    hidden::Bench bench({.coulomb = 30, .load = -20}, 5);
    static_cast<void>(bench.record({{0, 0, 10}}, 500));
    const Fit found = fit({series_in(bench.record({{20, 60000, 90, 3}}, 500))}, Model::mac140);
    EXPECT_TRUE(found[Parameter::inertia].told) << found[Parameter::inertia].why;
    EXPECT_TRUE(
        says(found[Parameter::coulomb], "not to be told from constant_load: the shaft turned one way only"));
    EXPECT_TRUE(
        says(found[Parameter::load], "not to be told from coulomb_friction: the shaft turned one way only"));
}

// It has long been at its speed when the recording begins, and goes on.
TEST(Fit, WithoutAccelerationInertiaIsNotTold) {
    hidden::Bench bench({.ripple = 0.2}, 6);
    static_cast<void>(bench.record({{0, 1e6, 80}}, 400));
    const Fit found = fit({series_in(bench.record({}, 600))}, Model::mac140);
    EXPECT_TRUE(says(found[Parameter::inertia], "record a move that accelerates"))
        << found[Parameter::inertia].value;
    EXPECT_FALSE(found[Parameter::coulomb].told);
    EXPECT_FALSE(found[Parameter::viscous].told);
    EXPECT_EQ(found_plant(found, Model::mac140, "MAC140", {}).plant.inertia, std::nullopt);
}

// Forward and backward at 60, and nothing between is recorded.
TEST(Fit, OfOneSpeedTheKindsOfFrictionAreNotToldApart) {
    hidden::Bench bench({.coulomb = 30}, 7);
    static_cast<void>(bench.record({{0, 1e6, 60, 30}}, 200));
    std::vector<Series> all;
    all.push_back(series_in(bench.record({}, 500)));
    static_cast<void>(bench.record({{0, -1e6, 60, 30}}, 200));
    all.push_back(series_in(bench.record({}, 500)));
    const Fit found = fit(all, Model::mac140);
    EXPECT_TRUE(says(found[Parameter::viscous], "all of the motion was at one speed"))
        << found[Parameter::viscous].why;
    EXPECT_TRUE(says(found[Parameter::coulomb], "not to be told from viscous_friction"))
        << found[Parameter::coulomb].why;
    EXPECT_TRUE(found[Parameter::load].told) << found[Parameter::load].why;
}

TEST(Fit, WhatIsToldBecomesAFileThatSimulatorsRead) {
    const Axis axis{.inertia = 12, .coulomb = 25, .viscous = 0.1, .load = 15, .dead_time = 0.8};
    const std::vector<Series> all = whole(axis, 8);
    const Fit found = fit(all, Model::mac140);
    const FoundPlant plant = found_plant(found, Model::mac140, "MAC140", {});
    const std::string text = axis_file(found, plant, {"a.csv", "b\"\n.csv"});
    const plant_file::Reading read = plant_file::read_plant(text, "axis.toml");
    ASSERT_EQ(read.error, "") << text;
    const plant_file::Load load = plant_file::in_motor_terms(read.plant, Model::mac140);
    EXPECT_NEAR(load.inertia.value_or(0), 12 / (1023 / 218.75), 0.03);  // 3500 / 16 counts/sample^2 bare
    EXPECT_NEAR(load.coulomb_friction.value_or(0), 25, 0.5);
    EXPECT_NEAR(load.viscous_friction.value_or(0), 0.1, 0.01);
    EXPECT_NEAR(load.constant_load.value_or(0), 15, 0.5);
    EXPECT_NEAR(load.dead_time.value_or(0), 0.8, 0.1);
    EXPECT_NE(text.find("# torque_constant is not told: motion tells torques as parts"), std::string::npos);
}

// Each recording strays from its own beginning on.
TEST(Fit, ThePictureComparesEachRecordingFromItsStart) {
    const std::vector<Series> all = whole({}, 10);
    const Recording picture = comparison(fit(all, Model::mac140), all, Model::mac140);
    ASSERT_EQ(picture.size(), 2U * 894U);
    ASSERT_EQ(picture.columns.size(), 4U);
    for (const std::size_t first : {0U, 894U})
        EXPECT_LT(std::abs(picture.columns[3].values[first]), 3) << first;
    EXPECT_EQ(picture.columns[2].values[0], all[0].torque[1]);
}

// The motor gives 0.9 of its torque: it seems to be of 12 / 0.9 where it is of 12.
TEST(Fit, AKnownInertiaTellsTheTorqueConstant) {
    const std::vector<Series> all = whole({.inertia = 12 / 0.9, .coulomb = 20 / 0.9}, 9);
    const plant_file::Motor motor = plant_file::motor_of(Model::mac140);
    const double known = 12 / (1023 / 218.75) * motor.inertia;
    const FoundPlant plant = found_plant(fit(all, Model::mac140), Model::mac140, "MAC140", known);
    EXPECT_NEAR(plant.plant.torque_constant.value_or(0), 0.9, 0.01);
    EXPECT_LT(plant.low.torque_constant.value_or(1), 0.9);
    EXPECT_GT(plant.high.torque_constant.value_or(0), 0.9);
    EXPECT_NEAR(plant.plant.inertia.value_or(0), known, 1e-3 * known);
    EXPECT_NEAR(plant.plant.coulomb_friction.value_or(0), 20 * motor.full_torque / 1023,
                0.02 * motor.full_torque);
}

// 12 x 80 / 16 + 25 + 0.1 x 1600 / 16 + 15 = 110.
TEST(Fit, AMoveNeedsTheSumOfItsTorques) {
    Fit found;
    found.estimates = {Estimate{12, 12, 12, true, {}}, Estimate{25, 25, 25, true, {}},
                       Estimate{0.1, 0.1, 0.1, true, {}}, Estimate{-15, -15, -15, true, {}},
                       Estimate{1, 1, 1, true, {}}};
    const MoveNeed need = need_of(found, 1600, 80, 100);
    EXPECT_NEAR(need.torque, 110, 1e-9);
    EXPECT_NEAR(need.excess(), 0.1, 1e-9);
    EXPECT_EQ(need.without, "");
    found.estimates[3].told = false;
    EXPECT_NEAR(need_of(found, 1600, 80, 100).torque, 95, 1e-9);
    EXPECT_EQ(need_of(found, 1600, 80, 100).without, "constant_load");
}

}  // namespace
}  // namespace nplc::macreg
