#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nplc::sim {
namespace {

ParsedScenario parse_for(const std::string& line, std::string_view motor) {
    const registers::DriveModel* model = registers::find_drive(motor);
    Names names;
    names.motor = model->map;
    if (model->family->is_translated()) names.drive = model;
    return parse_scenario(line, "x.scn", names);
}

/// The one mistake of a line.
std::string said_of(const std::string& line, std::string_view motor = "MAC140") {
    const ParsedScenario parsed = parse_for(line, motor);
    return parsed.mistakes.size() == 1 ? parsed.mistakes.front().message : "(no mistake)";
}

/// `line:column message`
std::string placed(const std::string& line) {
    const Mistake mistake = parse_for(line, "MAC140").mistakes.at(0);
    return mistake.place() + " " + mistake.message;
}

// Who has what: 001 §3.2.36 (the pins), 004 (brake, 24 V, DEGC, encoder), 003 §II.1 (one supply), §IV
// (inputs).
TEST(ScenarioDrive, OnlyWhatTheDriveHasIsTaken) {
    const std::pair<std::string, std::string> parts[] = {
        {"motor brake 300", "MAC800"},
        {"motor logic 15 V", "MAC800"},
        {"motor temperature 90", "MAC800 MAC23 MAC34-1"},
        {"motor encoder broken", "MAC800 MAC23 MAC34-1"},
        {"motor pulses 5000 per s", "MAC800"},
        {"motor steps 5000 per s", "MAC800"},
        {"motor analogue 5 V", "MAC50 MAC95 MAC140 MAC141 MAC800"},
        {"motor sensor on below 1 rev", "MAC50 MAC95 MAC140 MAC141 MAC800"},
        {"motor stop above 1 rev spring 5 per rev", "MAC50 MAC95 MAC140 MAC141 MAC800"},
        {"motor stop above 1 rev", "MAC50 MAC95 MAC140 MAC141 MAC800 MAC23 MAC34-1"},
        {"motor supply 20 V", "MAC50 MAC95 MAC140 MAC141 MAC800 MAC23 MAC34-1"},
        {"motor load 1100", "MAC50 MAC95 MAC140 MAC141 MAC800 MAC23 MAC34-1"},
        {"motor plant \"axis.toml\"", "MAC50 MAC95 MAC140 MAC141 MAC800"},
        {"motor power off", "MAC50 MAC95 MAC140 MAC141 MAC800 MAC23 MAC34-1"},
        {"motor error", "MAC50 MAC95 MAC140 MAC141 MAC800 MAC23 MAC34-1"},
        {"motor upper_stop on", "MAC23 MAC34-1"},
        {"motor lower_stop on below 1 rev", "MAC23 MAC34-1"},
        {"motor reference on above 1 rev", "MAC23 MAC34-1"},
        {"motor security on for 1 s", "MAC23 MAC34-1"},
    };
    for (const auto& [line, who] : parts) {
        for (const std::string_view motor :
             {"MAC50", "MAC95", "MAC140", "MAC141", "MAC800", "MAC23", "MAC34-1"}) {
            const bool has = (" " + who + " ").find(" " + std::string(motor) + " ") != std::string::npos;
            const std::string said = said_of(line, motor);
            if (has) {
                EXPECT_EQ(said, "(no mistake)") << line << " " << motor;
            } else {
                EXPECT_TRUE(said.starts_with("a " + std::string(motor) + " has ") ||
                            said.starts_with("a " + std::string(motor) + " does not "))
                    << line << " " << motor << ": " << said;
            }
        }
    }
}

TEST(ScenarioDrive, WhyADriveHasItNotIsTold) {
    EXPECT_EQ(placed("at 1 s motor pulses 5000 per s"),
              "1:14 a MAC140 has FastMAC on the pins of its pulse input (001 §3.2.36, USERINTF), so V_EXT "
              "stays 0; only a "
              "MAC800 has both, and macsim without --fastmac leaves the pins free");
    EXPECT_EQ(placed("motor logic 15 V"), "1:7 a MAC140 has one supply; write motor supply");
    EXPECT_EQ(said_of("motor logic 15 V", "MAC34-1"),
              "a MAC34-1 has one supply for all (003 §II.1); write motor supply");
    EXPECT_EQ(
        said_of("motor reference on"),
        "a MAC140 has no such input; MIDI drives have (--motor MAC34-1). Write motor sensor, or motor stop");
    EXPECT_EQ(said_of("motor reference", "MAC34-1"), "the line ends too early; write 0 or 1");
}

// HW_SETUP's bits by 004: DIRAWR, DIRBWR, PULSEOUT, XSEL1, XPRINP, NOFILT, INVXDIR from 0 on.
TEST(ScenarioDrive, WhatTheFlashHoldsIsGivenFromTheStart) {
    const auto stored = [](const std::string& line, std::string_view motor = "MAC800") {
        const ParsedScenario parsed = parse_for(line, motor);
        EXPECT_TRUE(parsed.mistakes.empty()) << line;
        return parsed.scenario.registers.at(0);
    };
    EXPECT_EQ(stored("motor HW_SETUP := XPRINP NOFILT  # bits 4 and 5").number, 39);
    EXPECT_EQ(stored("motor HW_SETUP := XPRINP NOFILT").bits, 0x30U);
    EXPECT_EQ(stored("motor HW_SETUP := 16#30").bits, 0x30U);
    EXPECT_EQ(stored("motor hw_setup := 48").bits, 48U);
    EXPECT_EQ(stored("motor FLWERRMAX := 0.5 rev", "MAC140").bits, 2048U);
    EXPECT_EQ(said_of("motor HW_SETUP := XPRIMP", "MAC800"),
              "\"XPRIMP\" is no bit of HW_SETUP; did you mean XPRINP?");
    EXPECT_EQ(
        said_of("motor HW_SETUP := OTHER_BIT", "MAC800"),
        "\"OTHER_BIT\" is no bit of HW_SETUP; write some of DIRAWR, DIRBWR, PULSEOUT, XSEL1, XPRINP, NOFILT, "
        "INVXDIR, or a number");
    EXPECT_EQ(stored("motor END_STOPS := 9", "MAC34-1").number, 0x03);  // 003 §VII
    EXPECT_EQ(stored("motor END_STOPS := 9", "MAC34-1").bits, 9U);
    EXPECT_EQ(said_of("motor END_STOPS := 2", "MAC34-1"), "END_STOPS takes 0 to 9: 0, 1, 8 or 9");
    EXPECT_TRUE(
        said_of("motor STOP := 2", "MAC34-1")
            .starts_with("a MIDI drive has no parameter STOP; write one of STOP_TORQUE, END_STOPS, "));
    EXPECT_EQ(said_of("motor HW_SETUP := 1"),
              "a MAC140 has no register HW_SETUP; registers are called as in the manual");
    EXPECT_EQ(said_of("motor P_IST := 1"),
              "P_IST is what the motor itself counts or shows; its flash does not hold it");
    EXPECT_EQ(said_of("motor HW_SETUP :=", "MAC800"),
              "the line ends too early; write a value such as 12, 16#1F, 5 rev or names of bits");
    EXPECT_EQ(
        said_of("at 1 s motor HW_SETUP := 1", "MAC800"),
        "a register is stored before the run begins; write such as motor HW_SETUP := NOFILT alone in a line");
    EXPECT_EQ(said_of("motor I2TLIM := 70000"),
              "I2TLIM takes 0 to 65535, in its own steps or with a unit as macreg takes it");
    EXPECT_EQ(said_of("motor I2TLIM := 5 rev"), "I2TLIM has no unit; write the number alone");
    EXPECT_EQ(
        placed("motor ACC_EMERG := 5 mm"),
        "1:22 \"mm\" is no unit of ACC_EMERG; write rpm/s, rev/s2, counts/s2, or the number alone in its "
        "own steps");
}

TEST(ScenarioDrive, APlantFileIsNamedOnceAndInQuotes) {
    const ParsedScenario parsed = parse_for("IN0 := 1\nmotor plant \"a/axis.toml\"", "MAC140");
    ASSERT_TRUE(parsed.mistakes.empty());
    ASSERT_TRUE(parsed.scenario.plant);
    EXPECT_EQ(parsed.scenario.plant->file, "a/axis.toml");
    EXPECT_EQ(parsed.scenario.plant->line, 2);
    EXPECT_EQ(placed("motor plant axis"),
              "1:13 \"axis\" is out of place; write the file in quotes, such as motor plant \"axis.toml\"");
    EXPECT_EQ(placed("motor plant \"a\"\nmotor plant \"b\""),
              "2:7 the scenario has a plant already; keep one of the two");
}

}  // namespace
}  // namespace nplc::sim
