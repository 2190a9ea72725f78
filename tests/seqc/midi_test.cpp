// Programs for MIDI drives: 1500 rpm is period 32 on a MAC34 (48000 / 32) and 160 on a MAC23 (240000 / 160);
// a revolution is 10000 and 2000 increments (000 §I, §VI 0Dh).
#include <gtest/gtest.h>

#include "seqc/decompile.h"
#include "seqc/symbol_file.h"
#include "support.h"

namespace nplc::seqc {
namespace {

std::string program(const std::string& motor, const std::string& values) {
    return "PROGRAM P\nMOTOR " + motor + ";\nSCALE 1 rev = 5 mm;\nVAR_MOTOR " + values +
           " END_VAR\n"
           "POWER_UP INIT(V1, A1); NEXT := S; END_POWER_UP\n"
           "STEP S: OWN ERROR; IF IN0 THEN POSITION(P1); NEXT := T; END_IF END_STEP\n"
           "STEP T: OWN ERROR; IF INPOS THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
}

const std::string kValues = "There AT P1 := 60 mm; Fast AT V1 := 1500 rpm; Soft AT A1 := 81;";

std::string lines_of(const std::string& source) {
    const Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    std::string text;
    for (const Rounding& rounding : result.roundings) text += rounding.text + "\n";
    return text;
}

bool says(const std::string& source, const std::string& code) {
    const Compilation result = compile(source);
    for (const Diagnostic& d : result.diagnostics) {
        if (d.code == code) return true;
    }
    return false;
}

TEST(MidiPrograms, TheTableIsThatOfAMac140) {
    const auto jvl = compile(program("MAC140", kValues));
    for (const char* name : {"MAC34", "mac34_1", "MAC34_2", "MAC23"}) {
        const auto midi = compile(program(name, kValues));
        ASSERT_TRUE(midi.ok) << name;
        EXPECT_EQ(midi.table, jvl.table) << name;
        EXPECT_TRUE(midi.symbols.drive) << name;
    }
    EXPECT_FALSE(jvl.symbols.drive);
}

/// The recipe "Indexing with a remainder" with a drive whose gateway adds distances up in counts: 18 stations
/// of 28,672 counts are 17 of 1593 and one of 1591.
TEST(MidiPrograms, AnIndexerWithARemainderHasNoWarning) {
    const auto indexer = [](const std::string& last) {
        return "PROGRAM P\nMOTOR MAC34;\nSCALE 7 rev = 360 deg;\nCONST Tubes := 18;\n"
               "VAR_MOTOR Pitch AT P1 := 360 deg / Tubes; Last AT P2 := " +
               last +
               "; Fast AT V1 := 600 rpm; Soft AT A1 := 4000 rpm/s; Window AT INPOSWIN := 6; END_VAR\n"
               "ON ERROR NEXT := Fault;\n"
               "POWER_UP INIT(Fast, Soft); CLEAR_P_IST; CLEAR_P_SOLL; POSITIONS_RELATIVE_P_SOLL; "
               "COUNTER := Tubes - 1; NEXT := Ready; END_POWER_UP\n"
               "STEP Ready: IF R_TRIG(IN0) THEN NEXT := Choose; END_IF END_STEP\n"
               "STEP Choose: IF COUNTER.Q THEN NEXT := Closing; ELSE NEXT := One; END_IF END_STEP\n"
               "STEP One: ENTRY POSITION(Pitch); ENTRY COUNT_DOWN; IF INPOS WITHIN T#2s THEN NEXT := Ready; "
               "ELSE "
               "NEXT := Fault; END_IF END_STEP\n"
               "STEP Closing: ENTRY POSITION(Last); ENTRY COUNTER := Tubes - 1; IF INPOS WITHIN T#2s THEN "
               "NEXT := "
               "Ready; ELSE NEXT := Fault; END_IF END_STEP\n"
               "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND R_TRIG(IN1) THEN RESET_ERROR; NEXT := "
               "POWER_UP; "
               "END_IF END_STEP\nEND_PROGRAM\n";
    };
    const std::string good = indexer("360 deg - (Tubes - 1) * Pitch");
    const Compilation result = compile(good);
    EXPECT_TRUE(result.ok && result.diagnostics.empty()) << test::shown(result, good);
    EXPECT_TRUE(says(indexer("360 deg / Tubes"), "W030"));
}

TEST(MidiPrograms, TheListingHasTheDrivesOwnSteps) {
    const std::string text = lines_of(program("MAC34", kValues));
    EXPECT_NE(text.find("60 mm is 49152, on a MAC34 120000 increments (60 mm, +0.000 %)"), std::string::npos)
        << text;
    EXPECT_NE(text.find("1500 rpm is 3146, on a MAC34 period 32 (1500 rpm, +0.000 %)"), std::string::npos)
        << text;
    const std::string other = lines_of(program("MAC23", kValues));
    EXPECT_NE(other.find("60 mm is 49152, on a MAC23 24000 increments"), std::string::npos) << other;
    EXPECT_NE(other.find("1500 rpm is 3146, on a MAC23 period 160 (1500 rpm"), std::string::npos) << other;
}

// 250000 increments/s with 81 x 41391.1 increments/s^2: v^2 / 2a is 9320.9 increments, 77.67 x 120.
TEST(MidiPrograms, TheRampComesFromVelocityAndAccelerationTogether) {
    const std::string text = lines_of(program("MAC34", kValues));
    EXPECT_NE(text.find("on a MAC34 a ramp of 78 x 120 increments"), std::string::npos) << text;
}

// 3000 rpm is period 16; the next ones are 3200 and 2823.5 rpm.
TEST(MidiPrograms, CoarsePeriodsAreWarnedOf) {
    const auto with_speed = [](const std::string& speed) {
        return program("MAC34", "There AT P1 := 60 mm; Fast AT V1 := " + speed + "; Soft AT A1 := 200;");
    };
    EXPECT_FALSE(says(with_speed("3000 rpm"), "W002"));
    EXPECT_TRUE(says(with_speed("2900 rpm"), "W002"));
    EXPECT_FALSE(says(with_speed("-3000 rpm"), "W002"));
}

// The window is smaller than 104.9 counts on a MAC34 and 524.3 on a MAC23: 256 increments, of which the ends
// count.
TEST(MidiPrograms, WindowsHaveTheirDrivesLimits) {
    const auto with_window = [](const std::string& motor, const std::string& window) {
        return program(motor, kValues + " Near AT Z1 := " + window + ";");
    };
    EXPECT_FALSE(says(with_window("MAC34", "104"), "E044"));
    EXPECT_TRUE(says(with_window("MAC34", "105"), "E044"));
    EXPECT_FALSE(says(with_window("MAC23", "524"), "E044"));
    EXPECT_TRUE(says(with_window("MAC23", "525"), "E044"));
    EXPECT_TRUE(says(with_window("MAC34", "0"), "E044"));
}

TEST(MidiPrograms, WhatWaitsForStandstillIsSaid) {
    const auto in_motion = [](const std::string& statement) {
        return "PROGRAM P\nMOTOR MAC34;\nVAR_MOTOR V1_ AT V1 := 600 rpm; A1_ AT A1 := 40; END_VAR\n"
               "POWER_UP INIT(V1, A1); NEXT := S; END_POWER_UP\n"
               "STEP S: OWN ERROR; IF IN0 THEN VELOCITY(V1); NEXT := T; END_IF END_STEP\n"
               "STEP T: OWN ERROR; IF IN1 THEN " +
               statement +
               " NEXT := U; END_IF END_STEP\n"
               "STEP U: OWN ERROR; IF IN2 THEN STOP; NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
    };
    EXPECT_FALSE(says(in_motion("VELOCITY(V2);"), "W015"));
    EXPECT_FALSE(says(in_motion("V_SOLL := 300 rpm;"), "W015"));
    EXPECT_FALSE(says(in_motion("T_SOLL := 50 %peak;"), "W015"));
    EXPECT_FALSE(says(in_motion("INIT(A1);"), "W015"));
    EXPECT_FALSE(says(in_motion("STOP;"), "W015"));
    EXPECT_TRUE(says(in_motion("VELOCITY(A1);"), "W015"));
    EXPECT_TRUE(says(in_motion("A_SOLL := 41;"), "W015"));
    EXPECT_TRUE(says(in_motion("POSITION(P1);"), "W015"));
}

// The gateway knows of a drive's registers only what a program writes (firmware/motor/MIDI.md).
TEST(MidiPrograms, ARegisterThatIsNeverGivenIsWarnedOf) {
    const auto with = [](const std::string& motor, const std::string& statement) {
        return "PROGRAM P\nMOTOR " + motor +
               ";\nVAR_MOTOR There AT P1 := 1 rev; Fast AT V1 := 600 rpm; Soft AT A1 := 40; END_VAR\n"
               "POWER_UP INIT(Fast, Soft); NEXT := S; END_POWER_UP\n"
               "STEP S: OWN ERROR; IF IN0 THEN " +
               statement +
               " NEXT := T; END_IF END_STEP\n"
               "STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
    };
    for (const char* given : {"POSITION(P1);", "INIT(V1);", "INIT(V1, A1);", "USE_SET(1);",
                              "V_SOLL := 300 rpm;", "T2 := 50 %peak; INIT(T2);"})
        EXPECT_FALSE(says(with("MAC34", given), "W017")) << given;
    for (const char* unset :
         {"POSITION(P2);", "INIT(V2);", "INIT(A3);", "INIT(T2);", "INIT(Z1);", "USE_SET(2);"}) {
        EXPECT_TRUE(says(with("MAC23", unset), "W017")) << unset;
        EXPECT_FALSE(says(with("MAC140", unset), "W017")) << unset << ": it may be in the motor's flash";
    }
    // A term of bytes gives V2 = 320: 42h is register 66 with 16 bits (001 §6.1.4).
    const std::string by_bytes = with("MAC34", "INIT(V2);");
    EXPECT_FALSE(says(by_bytes.substr(0, by_bytes.find("END_PROGRAM")) +
                          "TERM 16#02, 0, 16#80, 16#42, 16#40, 16#01, 0, 0;\nEND_PROGRAM\n",
                      "W017"));
}

TEST(MidiPrograms, DecompileNamesTheDrive) {
    const Compilation program_34 = compile(program("MAC34", kValues));
    DecompileOptions options{.origin = "p.bin", .motor = registers::Model::mac140};
    options.drive = registers::find_drive("MAC34-1");
    const Decompilation said = decompile(program_34.table, options);
    EXPECT_NE(said.text.find("\nMOTOR MAC34;\n"), std::string::npos) << said.text;
    EXPECT_EQ(compile(said.text).table, program_34.table);
    const Compilation program_23 = compile(program("MAC23", kValues));
    const Decompilation known =
        decompile(program_23.table, {.origin = "p.bin", .motor = {}, .symbols = &program_23.symbols});
    EXPECT_NE(known.text.find("\nMOTOR MAC23;\n"), std::string::npos) << known.text;
    EXPECT_EQ(compile(known.text).table, program_23.table);
}

TEST(MidiPrograms, DecompileNamesADriveOnlyForWhatItCanDo) {
    const Compilation homing = compile(
        "PROGRAM P\nMOTOR MAC140;\nPOWER_UP INIT(V1); NEXT := S; END_POWER_UP\n"
        "STEP S: OWN ERROR; IF IN0 THEN HOME; NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n");
    ASSERT_TRUE(homing.ok);
    DecompileOptions options{.origin = "p.bin", .motor = registers::Model::mac140};
    options.drive = registers::find_drive("MAC34-1");
    const Decompilation result = decompile(homing.table, options);
    EXPECT_NE(result.text.find("\nMOTOR MAC140;\n"), std::string::npos) << result.text;
    EXPECT_NE(result.text.find("// It is written for a MAC140, because a MAC34 cannot execute HOME.\n"),
              std::string::npos)
        << result.text;
    EXPECT_EQ(compile(result.text).table, homing.table);
}

TEST(MidiPrograms, TheDriveStandsInTheSymbolFile) {
    const std::string source = program("MAC34_2", kValues);
    const std::string text = write_symbols(compile(source), source, "p.seq");
    EXPECT_NE(text.find("\"motor\": \"MAC34\""), std::string::npos) << text;
    const SymbolReading back = read_symbols(text);
    EXPECT_EQ(back.error, "");
    EXPECT_TRUE(back.file.symbols.drive);
    EXPECT_EQ(back.file.symbols.motor, registers::Model::mac140);
}

}  // namespace
}  // namespace nplc::seqc
