#include "registers/midi_motor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "registers/mac.h"
#include "registers/midi_scale.h"

namespace nplc::registers::midi {
namespace {

constexpr Model kModels[] = {Model::mac23, Model::mac34_1, Model::mac34_2};

// 001 §3.2.5: 4096 counts a revolution. 000 §I: 2000 increments on MAC23, 10000 on MAC34.
TEST(MidiMotorPosition, ARevolution) {
    EXPECT_EQ(increments_of_counts(Model::mac23, 4'096), 2'000);
    EXPECT_EQ(increments_of_counts(Model::mac34_1, 4'096), 10'000);
    EXPECT_EQ(increments_of_counts(Model::mac34_2, -4'096), -10'000);
    EXPECT_EQ(counts_of_increments(Model::mac23, -2'000), -4'096);
    EXPECT_EQ(counts_of_increments(Model::mac34_1, 10'000), 4'096);
    // 12 revolutions, as 60 mm at 5 mm a revolution.
    EXPECT_EQ(increments_of_counts(Model::mac34_1, 49'152), 120'000);
}

// 1 count is 0.488 increments on MAC23 and 2.441 on MAC34; 128 counts are 62.5 and 312.5: a half goes up.
TEST(MidiMotorPosition, Rounding) {
    EXPECT_EQ(increments_of_counts(Model::mac23, 1), 0);
    EXPECT_EQ(increments_of_counts(Model::mac23, 2), 1);
    EXPECT_EQ(increments_of_counts(Model::mac34_1, 1), 2);
    EXPECT_EQ(increments_of_counts(Model::mac34_1, -1), -2);
    EXPECT_EQ(increments_of_counts(Model::mac23, 128), 63);
    EXPECT_EQ(increments_of_counts(Model::mac23, -128), -62);
    EXPECT_EQ(increments_of_counts(Model::mac34_1, 128), 313);
    EXPECT_EQ(increments_of_counts(Model::mac34_1, -128), -312);
    EXPECT_EQ(counts_of_increments(Model::mac23, 1), 2);
    EXPECT_EQ(counts_of_increments(Model::mac34_1, 1), 0);
    EXPECT_EQ(counts_of_increments(Model::mac34_1, 2), 1);
    EXPECT_EQ(counts_of_increments(Model::mac34_1, -2), -1);
}

TEST(MidiMotorPosition, Range) {
    // 1073741823 x 256 / 625 = 439804650.7; -1073741824 x 256 / 625 = -439804651.1.
    EXPECT_EQ(increments_of_counts(Model::mac34_1, 439'804'650), 1'073'741'821);
    EXPECT_FALSE(increments_of_counts(Model::mac34_1, 439'804'651));
    EXPECT_EQ(increments_of_counts(Model::mac34_1, -439'804'651), -1'073'741'824);
    EXPECT_FALSE(increments_of_counts(Model::mac34_1, -439'804'652));
    for (const std::int32_t end : {INT32_MAX, INT32_MIN}) {
        EXPECT_FALSE(increments_of_counts(Model::mac34_2, end));
        EXPECT_TRUE(increments_of_counts(Model::mac23, end));
    }
    EXPECT_EQ(counts_of_increments(Model::mac34_1, kMaxPosition), 439'804'651);
    EXPECT_EQ(counts_of_increments(Model::mac34_1, kMinPosition), -439'804'651);
    // Beyond 32 bits, where P_IST wraps: 1073741823 x 256 / 125 = 2199023253.5 - 2^32.
    EXPECT_EQ(counts_of_increments(Model::mac23, kMaxPosition), -2'095'944'042);
    EXPECT_EQ(counts_of_increments(Model::mac23, kMinPosition), 2'095'944'040);
    EXPECT_EQ(counts_of_increments(Model::mac23, 1'048'575'999), 2'147'483'646);
}

TEST(MidiMotorPosition, AgainstExactFractions) {
    std::mt19937 dice(1);
    std::uniform_int_distribution<std::int32_t> any(-67'000'000, 67'000'000);
    for (const Model model : kModels) {
        const std::int64_t a_rev = facts_of(model).increments_per_rev;
        for (int i = 0; i < 20'000; ++i) {
            const std::int32_t counts = any(dice);
            const auto increments = increments_of_counts(model, counts);
            ASSERT_TRUE(increments);
            ASSERT_LE(std::abs(2 * (*increments * std::int64_t{4'096} - counts * a_rev)), 4'096) << counts;
            const std::int32_t back = counts_of_increments(model, *increments);
            ASSERT_LE(std::abs(back - counts), model == Model::mac23 ? 1 : 0);
            ASSERT_LE(std::abs(2 * (back * a_rev - *increments * std::int64_t{4'096})), a_rev);
        }
    }
}

// 001 §3.2.5: 1600 is 762.9 rpm. 48000 / 762.94 = 62.9, 240000 / 762.94 = 314.6.
TEST(MidiMotorSpeed, TheManualsExample) {
    EXPECT_EQ(period_of_v_soll(Model::mac34_1, 1'600), 63);
    EXPECT_EQ(period_of_v_soll(Model::mac23, 1'600), 315);
    EXPECT_EQ(period_of_v_soll(Model::mac23, -1'600), 315);
    EXPECT_EQ(v_soll_of_period(Model::mac23, 315), 1'598);  // 240000 / 315 = 761.9 rpm = 1597.8
}

TEST(MidiMotorSpeed, Limits) {
    EXPECT_EQ(period_of_v_soll(Model::mac34_1, 0), 0);
    EXPECT_FALSE(period_of_v_soll(Model::mac34_1, 1));
    EXPECT_EQ(period_of_v_soll(Model::mac34_1, 2), 50'332);  // 100663.296 / 2
    EXPECT_FALSE(period_of_v_soll(Model::mac23, 7));
    EXPECT_EQ(period_of_v_soll(Model::mac23, -8), 62'915);  // 503316.48 / 8
    EXPECT_EQ(period_of_v_soll(Model::mac34_1, 32'767), 3);
    EXPECT_EQ(period_of_v_soll(Model::mac34_1, -32'768), 3);
    EXPECT_EQ(period_of_v_soll(Model::mac23, 32'767), 15);
    EXPECT_EQ(v_soll_of_period(Model::mac23, 0), 0);
    EXPECT_EQ(v_soll_of_period(Model::mac34_1, 1), 32'767);
    EXPECT_EQ(v_soll_of_period(Model::mac34_1, 0xFFFF), 2);  // 1.54
}

// A unit is 3125 / 6 samples a second x 60 / (16 x 4096) = 15625 / 32768 rpm, so VVVV = k x 32768 / (15625
// v), to the nearest; nothing where the quotient itself is not in 1..65535.
TEST(MidiMotorSpeed, EveryValueIsTheNearest) {
    for (const Model model : kModels) {
        const std::int64_t dividend = std::int64_t{rpm_times_period(model)} * 32'768;
        for (int v = 1; v <= 32'767; ++v) {
            const std::int64_t divisor = std::int64_t{15'625} * v;
            const auto period = period_of_v_soll(model, static_cast<std::int16_t>(v));
            ASSERT_EQ(period.has_value(), divisor <= dividend && dividend <= 65'535 * divisor) << v;
            if (!period) continue;
            ASSERT_EQ(*period, (2 * dividend + divisor) / (2 * divisor)) << v;
        }
    }
}

// 001 §3.2.6: 160 is 662.2 rev/s^2. 1500 rpm on MAC34 are 250000 increments a second: 250000^2 / (2 x 6622300
// x 120) = 39.3.
TEST(MidiMotorRamp, TheManualsExample) {
    EXPECT_EQ(ramp_of_a_soll(Model::mac34_1, 160, 32), 40);
    // MAC23, 1500 rpm: period 160, 50000 increments a second; 1324460 increments/s^2: 7.9.
    EXPECT_EQ(ramp_of_a_soll(Model::mac23, 160, 160), 8);
}

TEST(MidiMotorRamp, NeverHarderThanAskedAndNeverSofterThanNeeded) {
    std::mt19937 dice(2);
    for (const Model model : kModels) {
        const long double a_unit = 3'125.0L / 6 * 3'125 / 6 / 16 * facts_of(model).increments_per_rev / 4'096;
        for (int i = 0; i < 20'000; ++i) {
            const auto period = static_cast<std::uint16_t>(1 + dice() % (i % 2 != 0 ? 400 : 0xFFFF));
            const auto a_soll = static_cast<std::uint16_t>(1 + dice() % (i % 3 != 0 ? 2'000 : 0xFFFF));
            const long double speed = 8e6L / period;
            const long double exact = speed * speed / (240 * a_unit * a_soll);
            const auto ramp = ramp_of_a_soll(model, a_soll, period);
            if (exact > 255.0001L) {
                ASSERT_FALSE(ramp) << a_soll << ' ' << period;
            } else if (exact < 254.9999L) {
                ASSERT_TRUE(ramp) << a_soll << ' ' << period;
                ASSERT_LT(std::fabs(*ramp - std::ceil(exact)), 0.5L) << a_soll << ' ' << period;
            }
        }
    }
}

TEST(MidiMotorRamp, Limits) {
    EXPECT_FALSE(ramp_of_a_soll(Model::mac34_1, 0, 0xFFFF));
    EXPECT_FALSE(ramp_of_a_soll(Model::mac34_1, 160, 0));
    EXPECT_EQ(ramp_of_a_soll(Model::mac34_1, 1, 0xFFFF), 1);
    EXPECT_EQ(ramp_of_a_soll(Model::mac34_1, 0xFFFF, 0xFFFF), 1);
    // 6442450.944 / 255 = 25264.5: the least A x period^2.
    EXPECT_EQ(ramp_of_a_soll(Model::mac34_1, 25'265, 1), 255);
    EXPECT_FALSE(ramp_of_a_soll(Model::mac34_1, 25'264, 1));
    EXPECT_EQ(limitation_of_profile(Model::mac34_1, 3'146, 160), Limitation::none);
    EXPECT_EQ(limitation_of_profile(Model::mac34_1, 3'146, 24), Limitation::too_soft);  // 24 x 32^2 = 24576
    EXPECT_EQ(limitation_of_profile(Model::mac34_1, 3'146, 0), Limitation::no_acceleration);
    EXPECT_EQ(limitation_of_profile(Model::mac34_1, 1, 160), Limitation::too_slow);
    EXPECT_EQ(limitation_of_profile(Model::mac34_1, 0, 0), Limitation::none);
}

TEST(MidiMotorTorque, RoundedDown) {
    EXPECT_EQ(torque_of_t_soll(1'023, 0x80), 0x80);
    EXPECT_EQ(torque_of_t_soll(1'022, 0x80), 0x7F);
    EXPECT_EQ(torque_of_t_soll(512, 0x80), 64);  // 64.06
    EXPECT_EQ(torque_of_t_soll(511, 0x80), 63);  // 63.9
    EXPECT_EQ(torque_of_t_soll(0, 0x80), 0);
    EXPECT_EQ(torque_of_t_soll(1'023, 0xFF), 0xFF);
    EXPECT_EQ(torque_of_t_soll(1'023, 0), 0);
    EXPECT_FALSE(torque_of_t_soll(1'024, 0x80));
}

// |error| < 32 counts: on MAC34 less than 78.125 increments, on MAC23 less than 15.625.
TEST(MidiMotorWindow, TheMostIncrementsInside) {
    EXPECT_EQ(tolerance_of_window(Model::mac34_1, 32), 78);
    EXPECT_EQ(tolerance_of_window(Model::mac23, 32), 15);
    EXPECT_EQ(tolerance_of_window(Model::mac23, 256), 124);  // less than 125
    EXPECT_EQ(tolerance_of_window(Model::mac23, 1), 0);
    EXPECT_FALSE(tolerance_of_window(Model::mac23, 0));
    EXPECT_EQ(tolerance_of_window(Model::mac34_1, 104), 253);  // 253.9
    EXPECT_FALSE(tolerance_of_window(Model::mac34_1, 105));    // 256.3
    EXPECT_EQ(tolerance_of_window(Model::mac23, 524), 255);    // 255.9
    EXPECT_FALSE(tolerance_of_window(Model::mac23, 525));      // 256.3
    EXPECT_FALSE(tolerance_of_window(Model::mac23, 0xFFFF));
}

TEST(MidiMotorOrders, EveryCommandIsDecided) {
    int lacking = 0;
    for (int command = 0; command < 128; ++command) {
        const Limitation limitation = limitation_of_command(static_cast<std::uint8_t>(command));
        EXPECT_EQ(limitation, limitation_of_command(static_cast<std::uint8_t>(command | 0x80)))
            << "the toggle is no matter";
        if (limitation == Limitation::none) continue;
        ++lacking;
        const int low = command & 0x1F;
        if (command >= 0x60) {
            EXPECT_TRUE(low == 0x04 || low == 0x08 || low == 0x09 || low == 0x10 || low == 0x16) << low;
        } else {
            EXPECT_TRUE(low >= 0x18 && low <= 0x1B) << "L";
            EXPECT_EQ(limitation, Limitation::load_factor);
        }
    }
    EXPECT_EQ(lacking, 5 + 3 * 4);
    EXPECT_EQ(limitation_of_command(0x70), Limitation::homing);
    EXPECT_EQ(limitation_of_command(0x64), Limitation::function_error);
}

Limitation word(std::uint8_t reg, std::uint16_t value) {
    return limitation_of_write(Model::mac34_1, reg, false, value);
}
Limitation longword(std::uint8_t reg, std::uint32_t value) {
    return limitation_of_write(Model::mac34_1, reg, true, value);
}

TEST(MidiMotorOrders, Registers) {
    EXPECT_EQ(word(MODE_REG, 2), Limitation::none);
    EXPECT_EQ(word(MODE_REG, 3), Limitation::mode);
    EXPECT_EQ(longword(P_SOLL, 439'804'650), Limitation::none);
    EXPECT_EQ(longword(P_SOLL, 439'804'651), Limitation::too_far);
    EXPECT_EQ(longword(P1 + 14, 0x8000'0000), Limitation::too_far);
    EXPECT_EQ(longword(P1 + 1, 0x8000'0000), Limitation::none) << "halves of two registers";
    EXPECT_EQ(word(V_SOLL, 1), Limitation::too_slow);
    EXPECT_EQ(word(V1 + 7, 0xFFFF), Limitation::too_slow);
    EXPECT_EQ(word(V1, 0xFFFE), Limitation::none);
    EXPECT_EQ(word(V1, 0), Limitation::none);
    EXPECT_EQ(word(A_SOLL, 0), Limitation::no_acceleration);
    EXPECT_EQ(word(T1 + 3, 1'024), Limitation::too_much_torque);
    EXPECT_EQ(word(INPOSWIN, 105), Limitation::window);
    EXPECT_EQ(word(Z1, 104), Limitation::none);
    EXPECT_EQ(word(L1, 256), Limitation::load_factor);
    EXPECT_EQ(word(P_REG_P, 3), Limitation::none);
    EXPECT_EQ(word(L_REG_P, 1), Limitation::load_factor);
    EXPECT_EQ(longword(P_IST, 0), Limitation::none);
    EXPECT_EQ(longword(P_IST, 1), Limitation::actual_position);
    EXPECT_EQ(word(P_IST, 0), Limitation::actual_position);
    EXPECT_EQ(longword(P_FNC, 0), Limitation::function_error);
    EXPECT_EQ(word(HOME_MODE, 13), Limitation::homing);
    EXPECT_EQ(word(GEARF1, 1), Limitation::gear);
    EXPECT_EQ(word(ANINP, 0), Limitation::analogue);
    EXPECT_EQ(word(ERR_STAT, 0), Limitation::no_register);
    EXPECT_EQ(word(127, 0), Limitation::no_register);
}

// 001 §3.2: a longword takes the next number too.
TEST(MidiMotorOrders, BothWordsOfALongwordCount) {
    EXPECT_EQ(longword(V_SOLL, 0x0001'0640), Limitation::none);
    EXPECT_EQ(longword(V_SOLL, 0x0000'0640), Limitation::no_acceleration);
    EXPECT_EQ(longword(T1 + 3, 1), Limitation::load_factor);
    EXPECT_EQ(longword(Z1 + 3, 32), Limitation::no_register);
    EXPECT_EQ(longword(INPOSWIN, 32), Limitation::no_register) << "INPOSCNT";
}

TEST(MidiMotorOrders, EveryLackHasWords) {
    for (int limitation = 0; limitation <= static_cast<int>(Limitation::window); ++limitation) {
        EXPECT_GT(text_of(static_cast<Limitation>(limitation)).size(), 20U) << limitation;
    }
}

}  // namespace
}  // namespace nplc::registers::midi
