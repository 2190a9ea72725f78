#include "registers/midi_scale.h"

#include <gtest/gtest.h>

#include <random>

namespace nplc::registers::midi {
namespace {

constexpr Model kScaledModels[] = {Model::mac23, Model::mac34_1, Model::mac34_2};

// 000 §VI 0Dh: 60 / (VVVV x 0.125e-6 x increments) = 240000 / VVVV and 48000 / VVVV.
TEST(MidiSpeed, TheManualsConstants) {
    EXPECT_EQ(rpm_times_period(Model::mac23), 240'000U);
    EXPECT_EQ(rpm_times_period(Model::mac34_1), 48'000U);
    EXPECT_EQ(rpm_times_period(Model::mac34_2), 48'000U);
}

// VV x 200 us: 5000 increments a second for 1, 20 (19.6) for 255; the next slower one.
TEST(MidiSpeed, Unstall) {
    EXPECT_EQ(unstall_of_speed(5'000), 1);
    EXPECT_FALSE(unstall_of_speed(5'001));
    EXPECT_EQ(unstall_of_speed(4'999), 2);
    EXPECT_EQ(unstall_of_speed(1'000), 5);
    EXPECT_EQ(unstall_of_speed(20), 250);
    EXPECT_FALSE(unstall_of_speed(19));  // 263.2
    EXPECT_FALSE(unstall_of_speed(0));
}

// v^2 / (2 a x 120): 10000^2 / (240 x 20833) = 20.0003, so 21; with 20834 it is 19.9994.
TEST(MidiRamp, RoundedUp) {
    EXPECT_EQ(ramp_of(10'000, 20'833), 21);
    EXPECT_EQ(ramp_of(10'000, 20'834), 20);
    EXPECT_EQ(ramp_of(1'200, 6'000), 1);  // exactly 1
    EXPECT_EQ(ramp_of(1'200, 5'999), 2);
    EXPECT_EQ(ramp_of(1'200, 1'000'000), 1);
    EXPECT_EQ(ramp_of(0, 1), 1);
}

// 255 x 240 = 61200: v^2 = 61200 a is the last that fits.
TEST(MidiRamp, Limits) {
    EXPECT_EQ(ramp_of(61'200, 61'200), 255);
    EXPECT_FALSE(ramp_of(61'200, 61'199));
    EXPECT_FALSE(ramp_of(61'201, 61'200));
    EXPECT_FALSE(ramp_of(1'000, 0));
    EXPECT_FALSE(ramp_of(0xFFFFFFFF, 0xFFFFFFFF));
    EXPECT_EQ(ramp_of(8'000'000, 0xFFFFFFFF), 63);  // 6.4e13 / 240 / 4294967295 = 62.09
}

TEST(MidiRamp, IsTheLeastThatIsGentleEnough) {
    constexpr unsigned kSeed = 9;
    std::mt19937 random(kSeed);
    int fitted = 0;
    for (int i = 0; i < 100'000; ++i) {
        const auto speed = static_cast<std::uint32_t>(1 + random() % 1'000'000);
        const auto acceleration = static_cast<std::uint32_t>(1 + random() % 100'000'000);
        const auto ramp = ramp_of(speed, acceleration);
        const auto square = std::uint64_t{speed} * speed;
        if (!ramp) {
            ASSERT_GT(square, 61'200ULL * acceleration) << "seed " << kSeed << ", round " << i;
            continue;
        }
        ++fitted;
        ASSERT_LE(square, 240ULL * *ramp * acceleration) << "seed " << kSeed << ", round " << i;
        ASSERT_TRUE(*ramp == 1 || square > 240ULL * (*ramp - 1U) * acceleration)
            << "seed " << kSeed << ", round " << i;
    }
    EXPECT_GT(fitted, 1'000);
}

// 000 §VI 27h: MAC23 2.5 x measure - 215, MAC34 2.45 x measure - 140.
TEST(MidiMeasures, Temperature) {
    EXPECT_EQ(temperature_of(Model::mac23, 86), 0);
    EXPECT_EQ(temperature_of(Model::mac23, 126), 100'000);
    EXPECT_EQ(temperature_of(Model::mac34_1, 57), -350);     // 139.65 - 140
    EXPECT_EQ(temperature_of(Model::mac34_2, 98), 100'100);  // 240.1 - 140
    EXPECT_EQ(temperature_of(Model::mac34_1, 0), -140'000);
    EXPECT_EQ(temperature_of(Model::mac34_1, 255), 484'750);
    EXPECT_EQ(measure_of_temperature(Model::mac34_1, -200'000), 0);
    EXPECT_EQ(measure_of_temperature(Model::mac34_1, 999'999), 255);
    EXPECT_EQ(measure_of_temperature(Model::mac34_1, 25'000), 67);  // 165 / 2.45 = 67.3
    EXPECT_EQ(measure_of_temperature(Model::mac23, 25'000), 96);    // 240 / 2.5
}

// MAC23 measure / 4.8, MAC34-1 x 0.4, MAC34-2 x 0.8.
TEST(MidiMeasures, Supply) {
    EXPECT_EQ(supply_of(Model::mac23, 115), 23'958);  // 23.9583 V
    EXPECT_EQ(supply_of(Model::mac23, 255), 53'125);
    EXPECT_EQ(supply_of(Model::mac34_1, 120), 48'000);
    EXPECT_EQ(supply_of(Model::mac34_1, 255), 102'000);
    EXPECT_EQ(supply_of(Model::mac34_2, 255), 204'000);
    EXPECT_EQ(measure_of_supply(Model::mac34_1, 200'000), 255);
    EXPECT_EQ(measure_of_supply(Model::mac34_1, -1), 0);
    EXPECT_EQ(measure_of_supply(Model::mac34_2, 48'000), 60);
}

TEST(MidiMeasures, EveryMeasureComesBack) {
    for (const Model model : kScaledModels) {
        for (int measure = 0; measure <= 255; ++measure) {
            const auto byte = static_cast<std::uint8_t>(measure);
            EXPECT_EQ(measure_of_temperature(model, temperature_of(model, byte)), measure);
            EXPECT_EQ(measure_of_supply(model, supply_of(model, byte)), measure);
        }
    }
}

}  // namespace
}  // namespace nplc::registers::midi
