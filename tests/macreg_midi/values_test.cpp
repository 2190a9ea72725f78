#include "macreg/midi/values.h"

#include <gtest/gtest.h>

namespace nplc::macreg::midi {
namespace {

const Scale kMac23Values{.model = Model::mac23, .imax = 0x80, .period = 800};
const Scale kMac34Values{.model = Model::mac34_1, .imax = 0x80, .period = 160};
const Scale kUnknown{};

const Parameter& named(const char* name) {
    return *find_parameter(name);
}

TEST(MidiQuantity, ReadsNumbersWithUnits) {
    EXPECT_EQ(read_quantity("1500 rpm")->size, (registers::Ratio{1500, 1}));
    EXPECT_EQ(read_quantity("-2.50REV")->size, (registers::Ratio{5, 2}));
    EXPECT_EQ(read_quantity("-2.50REV")->unit, "rev");
    EXPECT_TRUE(read_quantity("-2.50REV")->negative);
    EXPECT_EQ(read_quantity("0x1F")->size, (registers::Ratio{31, 1}));
    for (const char* wrong : {"", "rpm", "-", ".", "0x", "0x123456789", "1234567890123"})
        EXPECT_FALSE(read_quantity(wrong)) << wrong;
}

TEST(MidiQuantity, Positions) {
    // 000 §I: 2000 and 10000 increments a turn.
    EXPECT_EQ(typed_position("2.5rev", Model::mac23).value, 5'000);
    EXPECT_EQ(typed_position("-1 rev", Model::mac34_1).value, -10'000);
    EXPECT_FALSE(typed_position("0.00003rev", Model::mac34_1).exact);
    EXPECT_EQ(typed_position("20480", std::nullopt).value, 20'480);
    EXPECT_NE(typed_position("1rev", std::nullopt).error, "");
    EXPECT_NE(typed_position("1rpm", Model::mac23).error, "");
    EXPECT_NE(typed_position("99999999999", Model::mac23).error, "");
}

TEST(MidiQuantity, Periods) {
    // 000 §VI, the example: 300 rpm of a MAC23 is 0320h; 0Dh: 48000 / VVVV on MAC34.
    EXPECT_EQ(typed_period("300rpm", Model::mac23).value, 0x320);
    EXPECT_EQ(typed_period("-5rev/s", Model::mac23).value, -0x320);
    EXPECT_EQ(typed_period("10000 inc/s", std::nullopt).value, 0x320);
    EXPECT_EQ(typed_period("300rpm", Model::mac34_2).value, 160);
    EXPECT_FALSE(typed_period("301rpm", Model::mac34_2).exact);
    for (const char* wrong : {"0rpm", "1inc/s", "9000000inc/s", "5", "5rev", "x"})
        EXPECT_NE(typed_period(wrong, Model::mac23).error, "") << wrong;
    EXPECT_NE(typed_period("5rpm", std::nullopt).error, "");
}

TEST(MidiQuantity, Times) {
    EXPECT_EQ(typed_time("2s").value, 2'000'000);
    EXPECT_EQ(typed_time("0.5").value, 500'000);
    EXPECT_EQ(typed_time("200ms").value, 200'000);
    EXPECT_NE(typed_time("-1s").error, "");
    EXPECT_NE(typed_time("1h").error, "");
}

TEST(MidiValues, AreShownInUnits) {
    EXPECT_EQ(value_text(named("POSITION"), 20'480, kMac34Values), "20480 inc (2.0480 rev)");
    EXPECT_EQ(value_text(named("POSITION"), -1, kUnknown), "-1 inc");
    EXPECT_EQ(value_text(named("SPEED"), 0x320, kMac23Values), "300 rpm (10000 inc/s)");
    // 000 §VI 0Eh: 200 us an increment and unit.
    EXPECT_EQ(value_text(named("UNSTALL"), 5, kUnknown), "1000 inc/s");
    EXPECT_EQ(value_text(named("TORQUE"), 0x40, kMac34Values), "50 %");
    EXPECT_EQ(value_text(named("END_STOPS"), 9, kMac34Values), "both");
    // 000 §VI 27h: 2.45 x 68 - 140, 0.4 x 120; MAC23 2.5 x 100 - 215, 120 / 4.8.
    EXPECT_EQ(value_text(named("TEMPERATURE"), 68, kMac34Values), "26.6 C");
    EXPECT_EQ(value_text(named("SUPPLY"), 120, kMac34Values), "48.0 V");
    EXPECT_EQ(value_text(named("TEMPERATURE"), 100, kMac23Values), "35.0 C");
    EXPECT_EQ(value_text(named("SUPPLY"), 120, kMac23Values), "25.0 V");
    EXPECT_EQ(value_text(named("RELEASE"), 0x704, kUnknown), "7.4");
    EXPECT_EQ(value_text(named("STATUS"), 0, kUnknown), "no fault, no warning");
    // dd bit 1: encoder; ff bit 1: upper software stop.
    EXPECT_EQ(value_text(named("STATUS"), 0x02020000, kUnknown),
              "tripped: no encoder; stopped by the upper software stop");
    // 50000 inc/s over 53 x 120 inc: 50000^2 / (2 x 6360).
    EXPECT_EQ(value_text(named("RAMP"), 53, kMac34Values), "6360 inc (196540.88 inc/s2, 19.65 rev/s2)");
}

TEST(MidiValues, AreTypedInUnits) {
    EXPECT_EQ(typed_value(named("SPEED"), "300rpm", kMac23Values).raw, 0x320);
    EXPECT_EQ(typed_value(named("SPEED"), "raw:800", kUnknown).raw, 800);
    EXPECT_EQ(typed_value(named("TORQUE"), "50%", kMac34Values).raw, 0x40);
    const TypedValue third = typed_value(named("TORQUE"), "33%", kMac34Values);
    EXPECT_EQ(third.raw, 42) << "never more than was said";
    EXPECT_EQ(third.rounding, "TORQUE: 33% taken as 32.82 %");
    EXPECT_EQ(typed_value(named("RAMP"), "1920", kMac34Values).raw, 16);
    EXPECT_EQ(typed_value(named("RAMP"), "1921", kMac34Values).raw, 17) << "never steeper than was said";
    EXPECT_EQ(typed_value(named("RAMP"), "20rev/s2", kMac34Values).raw, 53);
    EXPECT_EQ(typed_value(named("UNSTALL"), "1000inc/s", kMac34Values).raw, 5);
    EXPECT_EQ(typed_value(named("END_STOPS"), "software", kMac34Values).raw, 8);
    EXPECT_EQ(typed_value(named("LOWER_STOP"), "-2rev", kMac34Values).raw, -20'000);
    EXPECT_EQ(typed_value(named("TOLERANCE"), "7", kMac34Values).raw, 7);
}

TEST(MidiValues, WrongOnesAreTold) {
    const std::pair<const char*, const char*> wrong[] = {
        {"POSITION", "5"},   {"TORQUE", "101%"},     {"TORQUE", "5"},        {"TORQUE", "raw:129"},
        {"SPEED", "-5rpm"},  {"SPEED", "raw:0"},     {"SPEED", "raw:65536"}, {"RAMP", "30601"},
        {"RAMP", "1inc/s2"}, {"UNSTALL", "19inc/s"}, {"UNSTALL", "-5inc/s"}, {"TOLERANCE", "256"},
        {"END_STOPS", "2"},  {"END_STOPS", "on"},    {"TOLERANCE", "-1"},    {"REFERENCE", "yes"},
    };
    for (const auto& [name, text] : wrong)
        EXPECT_NE(typed_value(named(name), text, kMac34Values).error, "") << name << text;
    EXPECT_EQ(typed_value(named("TOLERANCE"), "256", kMac34Values).error,
              "TOLERANCE: '256' is out of range: 0 inc to 255 inc");
}

TEST(MidiValues, WhatIsShownIsTakenAgain) {
    for (const Parameter& one : parameters()) {
        if (!one.command || !one.query) continue;
        for (const std::int64_t raw : {std::int64_t{1}, std::int64_t{8}}) {
            if (one.sort == Sort::choice && raw == 8 && one.choices.size() == 2) continue;
            std::string text = value_text(one, raw, kUnknown);
            text = text.substr(0, text.find(" ("));
            EXPECT_EQ(typed_value(one, text, kUnknown).raw, raw) << one.name << " " << text;
        }
    }
}

}  // namespace
}  // namespace nplc::macreg::midi
