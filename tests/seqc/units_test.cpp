#include "symbols/units.h"

#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

using registers::Model;

/// Raw value that `REGISTER := text` writes on a motor, through a whole program.
std::string written(const char* model, const std::string& assignment) {
    const std::string source = "PROGRAM P MOTOR " + std::string(model) +
                               "; SCALE 2 rev = 10 mm; STEP S: OWN ERROR; IF IN0 "
                               "THEN " +
                               assignment +
                               "; NEXT := T; END_IF END_STEP STEP T: OWN ERROR; END_STEP END_PROGRAM";
    const Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    const auto sends = test::scan(result.table, 1, 1, false, false).sends;
    return sends.empty() ? "" : sends[0];
}

TEST(Units, ManualsExamples) {
    EXPECT_EQ(written("MAC140", "V_SOLL := 762.9 rpm"), "5=1600");     // 001 §3.2.5
    EXPECT_EQ(written("MAC140", "A_SOLL := 39731 rpm/s"), "6=160");    // 001 §3.2.6
    EXPECT_EQ(written("MAC800", "V_SOLL := 100 rpm"), "5=277L");       // 004, register 5
    EXPECT_EQ(written("MAC800", "A_SOLL := 100000 rpm/s"), "6=360L");  // 004, register 6
    EXPECT_EQ(written("MAC140", "KVOUT := 3.9"), "13=998");            // 3.9 x 256 = 998.4
    EXPECT_EQ(written("MAC800", "KVOUT := 1.5"), "13=98304L");         // 1.5 x 65536
}

TEST(Units, Lengths) {
    EXPECT_EQ(written("MAC140", "P1 := 1 rev"), "49=4096L");
    EXPECT_EQ(written("MAC800", "P1 := 1 rev"), "49=8000L");
    EXPECT_EQ(written("MAC140", "P1 := 10 mm"), "49=8192L");     // 2 rev = 10 mm
    EXPECT_EQ(written("MAC140", "P_FNC := 2 counts"), "8=32L");  // 1/16 counts
    EXPECT_EQ(written("MAC140", "P1 := -1 counts"), "49=4294967295L");
    EXPECT_EQ(written("MAC140", "V_SOLL := -1"), "5=65535");
}

TEST(Units, SpeedsAndAccelerations) {
    // 5 mm/s = 1 rev/s = 4096 counts/s / 520.83 x 16 = 125.83
    EXPECT_EQ(written("MAC140", "V1 := 5 mm/s"), "65=126");
    EXPECT_EQ(written("MAC140", "V1 := 1 rev/s"), "65=126");
    EXPECT_EQ(written("MAC140", "V1 := 60 rpm"), "65=126");
    // 1000 rpm/s = 16.667 rev/s2 = 16.667 x 4096 / 520.83^2 x 16 = 4.0265
    EXPECT_EQ(written("MAC140", "A1 := 1000 rpm/s"), "73=4");
    EXPECT_EQ(written("MAC140", "A1 := 5000 mm/s2"), "73=242");  // 1000 rev/s2: 241.59
    EXPECT_EQ(written("MAC140", "A1 := 5000 mm/s/s"), "73=242");
}

TEST(Units, TorqueTimesAndPlainNumbers) {
    EXPECT_EQ(written("MAC140", "T_SOLL := 100 %peak"), "7=1023");
    EXPECT_EQ(written("MAC140", "T1 := 100 %nominal"), "77=341");  // 1023 / 3
    EXPECT_EQ(written("MAC140", "INPOSCNT := T#100ms"), "34=52");  // 0.1 s x 520.83 Hz
    EXPECT_EQ(written("MAC140", "INPOSCNT := 5 samples"), "34=5");
    EXPECT_EQ(written("MAC140", "MODE_REG := 3"), "2=3");
    EXPECT_EQ(written("MAC140", "CNTRL_BITS := 2#100_0000_0000"), "36=1024");
    EXPECT_EQ(written("MAC140", "KVOUT := 16#0100"), "13=256");  // bits, not the number 256
    EXPECT_EQ(written("MAC140", "V_SOLL := 16#FFFE"), "5=65534");
}

TEST(Units, VoltsDegreesAndAngles) {
    EXPECT_EQ(written("MAC140", "ANINP_OFFSET := 0.5 V"), "123=51");       // 51.15: 10 V is 1023
    EXPECT_EQ(written("MAC140", "ANINP_OFFSET := -500 mV"), "123=65485");  // -51
    EXPECT_EQ(written("MAC140", "ELDEGN_OFFSET := 90 eldeg"), "124=512");  // 2048 / 4
    EXPECT_EQ(written("MAC800", "DEGCMAX := 85 C"), "31=696L");            // 85 / 0.12207 = 696.32
}

TEST(Units, WhatDoesNotFitIsNothing) {
    const auto& speed = *registers::find(Model::mac140, "V_SOLL");
    EXPECT_EQ(raw_per_unit(speed, Model::mac140, std::nullopt, "mm/s"), std::nullopt);
    EXPECT_EQ(raw_per_unit(speed, Model::mac140, std::nullopt, "rpm/s"), std::nullopt);
    EXPECT_EQ(raw_per_unit(speed, Model::mac140, std::nullopt, "%peak"), std::nullopt);
    EXPECT_EQ(raw_per_unit(speed, Model::mac140, std::nullopt, "/s"), std::nullopt);
    const LengthUnit mm{"mm", 5};
    EXPECT_NE(raw_per_unit(speed, Model::mac140, mm, "mm / s"), std::nullopt);
    for (const char* unit : {"mm", "mmx/s", "m/s", "mm/s/s", "mm/mm/s", "mm/"}) {
        EXPECT_EQ(raw_per_unit(speed, Model::mac140, mm, unit), std::nullopt) << unit;
    }
    EXPECT_NE(raw_per_unit(speed, Model::mac140, std::nullopt, "RPM"), std::nullopt);
}

TEST(Units, RoundingIsTold) {
    const std::string source =
        "PROGRAM P MOTOR MAC140; VAR_MOTOR f AT V1 := 1500 rpm; g AT V2 := 16; END_VAR STEP S: OWN "
        "ERROR; END_STEP END_PROGRAM";
    const Compilation result = compile(source);
    ASSERT_EQ(result.roundings.size(), 1U);
    // 3145.728 becomes 3146: 1500.13 rpm, + 0.00865 %
    EXPECT_EQ(result.roundings[0].text, "V1 := 1500 rpm is 3146 (1500.13 rpm, +0.009 %)");
    EXPECT_NE(listing(result, source, "f.seq").find("V1 := 1500 rpm is 3146"), std::string::npos);
}

}  // namespace
}  // namespace nplc::seqc
