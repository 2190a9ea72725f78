#include "registers/scale.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::registers {
namespace {

double raw_of(Model model, std::string_view name, std::string_view unit) {
    const auto ratio = raw_per_unit(*find(model, name), model, unit);
    EXPECT_TRUE(ratio.has_value()) << name << " in " << unit;
    return ratio ? static_cast<double>(ratio->numerator) / static_cast<double>(ratio->denominator) : 0;
}

constexpr Model kSmallModel = Model::mac140;
constexpr Model kLargeModel = Model::mac800;

// 7812.5 / 15 = 3125/6 samples a second: 4096 x 16 / 60 / (3125/6) = 393216 / 187500, which is 32768 / 15625.
TEST(RegisterScale, IsExact) {
    EXPECT_EQ(raw_per_unit(*find(kSmallModel, "V_SOLL"), kSmallModel, "rpm"), (Ratio{32'768, 15'625}));
    // 8000 x 16 / 60 / 770 = 128000 / 46200
    EXPECT_EQ(raw_per_unit(*find(kLargeModel, "V_SOLL"), kLargeModel, "rpm"), (Ratio{640, 231}));
}

TEST(RegisterScale, ManualsFigures) {
    EXPECT_NEAR(raw_of(kSmallModel, "V_SOLL", "rpm"), 2.0972, 0.0001);      // 002: 2.097
    EXPECT_NEAR(1 / raw_of(kSmallModel, "V_SOLL", "rpm"), 0.4768, 0.0001);  // §3.2.5
    EXPECT_NEAR(1 / raw_of(kSmallModel, "V_IST", "rpm"), 7.629, 0.001);     // §3.2.12
    EXPECT_NEAR(1 / raw_of(kSmallModel, "A_SOLL", "rpm/s"), 248.3, 0.1);  // §3.2.6, with 520.8 for 520.83 Hz
    EXPECT_NEAR(raw_of(kSmallModel, "A_SOLL", "rpm/s") * 1000, 4.026, 0.001);  // 002
    EXPECT_NEAR(160 / raw_of(kSmallModel, "A_SOLL", "rev/s2"), 662.2, 0.1);
    EXPECT_NEAR(raw_of(kLargeModel, "V_SOLL", "rpm"), 2.77056, 0.00001);            // 004, register 5
    EXPECT_NEAR(raw_of(kLargeModel, "V_IST", "rpm"), 0.17316, 0.00001);             // 12
    EXPECT_NEAR(raw_of(kLargeModel, "A_SOLL", "rpm/s") * 1000, 3.598133, 0.00001);  // 6
    EXPECT_DOUBLE_EQ(raw_of(kSmallModel, "T_SOLL", "%peak"), 10.23);                // §3.2.7
    EXPECT_DOUBLE_EQ(raw_of(kLargeModel, "T_SOLL", "%nominal"), 3.41);              // 7: 1023 = 300 %
    EXPECT_DOUBLE_EQ(raw_of(kSmallModel, "ANINP", "V"), 102.3);                     // §3.2.122
    EXPECT_NEAR(1 / raw_of(kLargeModel, "ANINP", "V"), 0.0048828, 0.0000001);       // 170
    EXPECT_DOUBLE_EQ(1 / raw_of(kSmallModel, "U_SUPPLY", "mV"), 53.7);              // §3.2.151
    EXPECT_DOUBLE_EQ(1 / raw_of(kLargeModel, "U_24V", "V"), 0.013428);              // 21
    EXPECT_NEAR(raw_of(kLargeModel, "U_24V", "V"), 74.4713, 0.0001);                // 21 again
    EXPECT_DOUBLE_EQ(1 / raw_of(kLargeModel, "DEGC", "C"), 0.12207);                // 29
    EXPECT_NEAR(366 / raw_of(kLargeModel, "U_BUS", "V"), 325, 0.5);                 // 198's example
    EXPECT_NEAR(1 / raw_of(kSmallModel, "MAN_ALPHA", "eldeg"), 0.176, 0.001);       // §3.2.129
    EXPECT_DOUBLE_EQ(raw_of(kSmallModel, "V_ELDEG", "counts/s"), 1 / 7812.5);       // §3.2.144
    EXPECT_EQ(raw_of(kSmallModel, "V_SOLL", "counts/sample"), 16);                  // §3.2.5
}

TEST(RegisterScale, Lengths) {
    EXPECT_EQ(raw_of(kSmallModel, "P_SOLL", "rev"), 4096);
    EXPECT_EQ(raw_of(kLargeModel, "P_SOLL", "rev"), 8000);
    EXPECT_EQ(raw_of(kSmallModel, "P_FNC", "rev"), 65'536);  // 1/16 counts, §3.2.8
    EXPECT_EQ(raw_of(kSmallModel, "INPOSWIN", "counts"), 1);
    EXPECT_DOUBLE_EQ(raw_of(kSmallModel, "INPOSCNT", "ms"), 0.52083333333333333);
    EXPECT_DOUBLE_EQ(raw_of(kLargeModel, "INPOSCNT", "s"), 770);
}

TEST(RegisterScale, PlainNumbers) {
    EXPECT_EQ(raw_of(kSmallModel, "KVOUT", ""), 256);
    EXPECT_EQ(raw_of(kSmallModel, "KIFX2", " "), 4096);
    EXPECT_EQ(raw_of(kLargeModel, "KVOUT", ""), 65'536);
    EXPECT_EQ(raw_of(kLargeModel, "KFF5", ""), 16'777'216);
    EXPECT_EQ(raw_of(kSmallModel, "V_SOLL", ""), 1);
}

TEST(RegisterScale, CaseAndBlanksDoNotCount) {
    EXPECT_EQ(raw_of(kSmallModel, "V_SOLL", "RPM"), raw_of(kSmallModel, "V_SOLL", "rpm"));
    EXPECT_EQ(raw_of(kSmallModel, "A_SOLL", " rev / s / s "), raw_of(kSmallModel, "A_SOLL", "rev/s2"));
    EXPECT_EQ(raw_of(kSmallModel, "T_SOLL", "%"), raw_of(kSmallModel, "T_SOLL", "%peak"));
}

TEST(RegisterScale, WhatDoesNotFit) {
    const auto none = std::optional<Ratio>();
    for (const char* unit :
         {"rev", "rpm/s", "/s", "rpm/", "rpmm", "V", "%", "s", "rev/s/s/s", "a very long unit"}) {
        EXPECT_EQ(raw_per_unit(*find(kSmallModel, "V_SOLL"), kSmallModel, unit), none) << unit;
    }
    EXPECT_EQ(raw_per_unit(*find(kSmallModel, "MODE_REG"), kSmallModel, "rev"), none);
    EXPECT_EQ(raw_per_unit(*find(kSmallModel, "ERR_STAT"), kSmallModel, "V"), none);
    EXPECT_EQ(raw_per_unit(*find(kSmallModel, "V_SOLL"), kSmallModel, std::string(1000, 'r')), none);
}

// What is offered fits, in every register of both maps.
TEST(RegisterScale, EveryOfferedUnitFits) {
    for (const Model model : {kSmallModel, kLargeModel}) {
        for (const Register& reg : map_of(model)) {
            EXPECT_EQ(units_of(reg.unit).empty(), reg.unit == Unit::none || reg.unit == Unit::bits)
                << reg.name;
            for (const auto unit : units_of(reg.unit)) {
                const auto ratio = raw_per_unit(reg, model, unit);
                ASSERT_TRUE(ratio.has_value()) << reg.name << " in " << unit;
                EXPECT_GT(ratio->numerator, 0) << reg.name;
                EXPECT_GT(ratio->denominator, 0) << reg.name;
                EXPECT_EQ(std::gcd(ratio->numerator, ratio->denominator), 1) << reg.name << " in " << unit;
            }
        }
    }
}

}  // namespace
}  // namespace nplc::registers
