// Tables as programs. decompile.cases holds tables written on paper (bytes with the thought behind each) and
// what they must be read as; the examples are held against their own source.
#include "seqc/decompile.h"
#include "seqc/format.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "case_file.h"
#include "support.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

/// Hex bytes; a # begins a comment.
Bytes table_on_paper(const std::string& text) {
    Bytes table;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream bytes(line.substr(0, line.find('#')));
        for (std::string byte; bytes >> byte;)
            table.push_back(static_cast<std::uint8_t>(std::stoul(byte, nullptr, 16)));
    }
    return table;
}

Bytes with_end(Bytes table) {
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

Decompilation decompiled(const Bytes& table, const DecompileOptions& options = {}) {
    const Decompilation result = decompile(table, options);
    const Compilation again = compile(result.text);
    EXPECT_EQ(again.table, table) << test::shown(again, result.text) << result.text;
    EXPECT_EQ(format_program(result.text).text, result.text);
    return result;
}

/// The program from its first STEP to the end of that step.
std::string first_step(const Decompilation& result) {
    const std::size_t from = result.text.find("STEP ");
    return result.text.substr(from, result.text.find("END_STEP") - from);
}

/// Columns apart: no two spaces between words.
bool has(const Decompilation& result, const std::string& part) {
    return std::regex_replace(result.text, std::regex("(\\S) +"), "$1 ").find(part) != std::string::npos;
}

TEST(Decompile, TablesOnPaper) {
    const std::vector<test::Case> cases = test::read_cases(SEQC_TABLES);
    for (const test::Case& one : cases) {
        const Decompilation result =
            decompiled(table_on_paper(one.input), {.origin = one.name + ".bin", .motor = {}});
        EXPECT_EQ(result.text, one.expected) << one.name;
        EXPECT_EQ(result.byte_terms, 0U) << one.name;
    }
    EXPECT_EQ(cases.size(), 5U);
}

/// Words from ON ERROR to the end, one space between, without comments.
std::string words(std::string text) {
    text = std::regex_replace(text, std::regex("//[^\n]*"), "");
    text = text.substr(text.find("ON ERROR"));
    return std::regex_replace(text, std::regex("\\s+"), " ");
}

/// "ON Guard IN A, B NEXT := Fault;" as the first branch of each step, which is what a table has of it.
std::string spelt_out(std::string text) {
    std::smatch on;
    while (std::regex_search(text, on, std::regex("ON Guard IN ([^;]*) NEXT := (\\w+); "))) {
        const std::string steps = std::regex_replace(on[1].str(), std::regex(", "), "|");
        const std::string branch = "$1IF Guard THEN NEXT := " + on[2].str() + "; ELSIF ";
        text.erase(static_cast<std::size_t>(on.position()), static_cast<std::size_t>(on.length()));
        text = std::regex_replace(text, std::regex("(STEP (" + steps + "): ([^;]*; )*?)IF "), branch);
    }
    return text;
}

/// A time limit comes back as a preset and a test of the timer, so it is left out.
std::string without_limits(std::string text) {
    text = std::regex_replace(text, std::regex(" WITHIN T#[0-9]+s THEN"), " THEN");
    return std::regex_replace(text, std::regex("    ELSE\n        NEXT := Fault;\n"), "");
}

/// Names of registers and lengths too.
TEST(Decompile, ExamplesComeBackAsTheyWereWritten) {
    const std::map<std::string, std::vector<std::string>> heads = {
        {"pick_and_place",
         {"SCALE 1 rev = 5 mm;", "Home AT P1 := 0 mm;", "Place AT P2 := 60 mm;", "Fast AT V1 :="}},
        {"indexing_table", {"SCALE ", "Pitch AT P1 := ", "Swift AT V1 := ", "Gentle AT A1 := "}},
        {"fill_and_count", {"Belt AT V1 := ", "Soft AT A1 := "}},
    };
    for (const auto& [name, parts] : heads) {
        const std::string source =
            without_limits(test::text_of_file(fs::path(SEQC_EXAMPLES) / (name + ".seq")));
        const Compilation program = compile(source);
        const Decompilation result =
            decompiled(program.table, {.origin = name, .motor = {}, .symbols = &program.symbols});
        std::string wanted = spelt_out(words(source));
        wanted = std::regex_replace(wanted, std::regex("PROPERTY [^;]*; ?"), "");  // a table holds none
        // A product is written in the order of its inputs.
        if (name == "fill_and_count") {  // with its helper step, and the constant's value
            wanted = std::regex_replace(wanted, std::regex("Bottles"), "12");
            wanted = std::regex_replace(wanted, std::regex("ELSIF TIMER.Q THEN NEXT := Away"), "$&_");
            wanted = std::regex_replace(wanted, std::regex("Away_"), "Filled_to_Away");
            wanted = std::regex_replace(wanted, std::regex("END_PROGRAM"),
                                        "STEP Filled_to_Away: NEXT := Away; END_STEP $&");
        }
        wanted = std::regex_replace(wanted, std::regex("NOT Ack AND NOT Guard"), "NOT Guard AND NOT Ack");
        EXPECT_EQ(words(result.text), wanted) << name;
        for (const std::string& part : parts) EXPECT_TRUE(has(result, part)) << part << " in " << result.text;
        EXPECT_EQ(result.term_steps + result.mixed_steps, 0U) << name;
        const Compilation again = compile(result.text);
        EXPECT_EQ(again.diagnostics.size(), 0U) << name;
        EXPECT_EQ(again.symbols.scale, program.symbols.scale) << name;
        EXPECT_EQ(again.symbols.motor_names.size(), program.symbols.motor_names.size()) << name;
        EXPECT_EQ(decompiled(program.table).byte_terms, 0U) << name;
    }
}

TEST(Decompile, EntryWritesWhatPowerUpWouldWriteAsAValue) {
    const std::string steps =
        "STEP S: OWN ERROR; ENTRY V1 := 100 rpm; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\n";
    const Compilation plain = compile("PROGRAM P MOTOR MAC140;\n" + steps + "END_PROGRAM");
    ASSERT_TRUE(plain.ok);
    const Decompilation result = decompiled(plain.table);
    EXPECT_TRUE(has(result, "ENTRY V1 := 210;")) << result.text;
    EXPECT_FALSE(has(result, "VAR_MOTOR")) << result.text;
    const std::string fault = "STEP F: OWN ERROR; ENTRY V1 := 100 rpm; END_STEP ";
    const std::string guarded =
        "STEP U: IF IN2 THEN NEXT := S; END_IF END_STEP STEP W: IF IN2 THEN NEXT := U; "
        "END_IF END_STEP ";
    for (const std::string value : {"", "VAR_MOTOR A AT V1 := 100 rpm; END_VAR ",
                                    "VAR_MOTOR A AT V1 := 100 rpm; B AT V2 := 100 rpm; END_VAR "}) {
        for (const std::string first : {"S", "T", "F"}) {
            const std::string source = "PROGRAM P MOTOR MAC140; " + value +
                                       "ON ERROR NEXT := F; POWER_UP NEXT := " + first + "; END_POWER_UP " +
                                       steps + guarded + fault + "END_PROGRAM";
            const Compilation program = compile(source);
            ASSERT_TRUE(program.ok) << test::shown(program, source);
            decompiled(program.table);
        }
    }
}

// A length with digits behind the point, a name that a signal has, a register that POWER_UP gives no value.
TEST(Decompile, GivenRegistersAndTheScaleKeepTheBytes) {
    const Compilation program = compile(
        "PROGRAM P\nMOTOR MAC140;\nSCALE 3 rev = 7 mm;\nVAR_INPUT Start AT IN0 : BOOL; END_VAR\n"
        "VAR_MOTOR Near AT P1 := 12345; Far AT P2 := 7 mm; Slow AT V3; END_VAR\n"
        "STEP One: OWN ERROR; IF Start THEN VELOCITY(Slow); NEXT := Two; END_IF END_STEP\n"
        "STEP Two: OWN ERROR; ENTRY POSITION(Far); IF NOT Start THEN Near := 11 mm; NEXT := One; END_IF "
        "END_STEP\nEND_PROGRAM\n");
    ASSERT_TRUE(program.ok);
    Symbols symbols = program.symbols;
    const DecompileOptions options{.origin = {}, .motor = {}, .symbols = &symbols};
    const Decompilation result = decompiled(program.table, options);
    // 12345 counts are 12345 x 7 mm / (3 x 4096) = 7.03247 mm; a count is 0.00057 mm.
    for (const char* part : {"SCALE 3 rev = 7 mm;", "Near AT P1 := 7.0325 mm;", "Near := 11 mm;",
                             "Far AT P2 := 7 mm;", "Slow AT V3;", "VELOCITY(Slow)", "POSITION(Far)"})
        EXPECT_TRUE(has(result, part)) << part << " in " << result.text;
    EXPECT_EQ(compile(result.text).table, program.table);
    symbols.motor_names[0].name = "Start";
    symbols.motor_names[1].name = "no name";
    EXPECT_EQ(compile(decompiled(program.table, options).text).table, program.table);
}

// 10 mm a revolution: 1 mm/s is 6 rpm, 12.583 steps of V1, and 46.9 mm/s are 590.1; 1 step of A1 is 248.36
// rpm/s, 41.39 mm/s2, and 1325 mm/s2 are 32.01. So what comes back has units, and no warning of those that
// are missing (W039).
TEST(Decompile, RatesInTheUnitOfTheScale) {
    const Compilation program = compile(
        "PROGRAM P\nMOTOR MAC140;\nSCALE 1 rev = 10 mm;\n"
        "VAR_MOTOR Far AT P1 := 80 mm; Fast AT V1 := 16#24E; Soft AT A1 := 16#20; END_VAR\n"
        "POWER_UP INIT(Fast, Soft); NEXT := One; END_POWER_UP\n"
        "STEP One: OWN ERROR; IF IN0 THEN POSITION(Far); NEXT := Two; END_IF END_STEP\n"
        "STEP Two: OWN ERROR; IF INPOS AND NOT IN0 THEN NEXT := One; END_IF END_STEP\nEND_PROGRAM\n");
    ASSERT_TRUE(program.ok);
    const DecompileOptions options{.origin = {}, .motor = {}, .symbols = &program.symbols};
    const Decompilation result = decompiled(program.table, options);
    for (const char* part : {"Far AT P1 := 80 mm;", "Fast AT V1 := 46.9 mm/s;", "Soft AT A1 := 1325 mm/s2;"})
        EXPECT_TRUE(has(result, part)) << part << " in " << result.text;
    EXPECT_EQ(test::codes(compile(result.text)), "");
}

// 7 rev = 10 mm: 3333 counts are 1.162458 mm. To a place that is good enough, relative moves would add up
// what is lost (W030).
TEST(Decompile, DistancesOfRelativeMovesAreExact) {
    const auto source = [](const std::string& positions) {
        return "PROGRAM P\nMOTOR MAC140;\nSCALE 7 rev = 10 mm;\n"
               "VAR_MOTOR One AT P1 := 3333 counts; Two AT P2 := 20 mm; Fast AT V1 := 25 mm/s; END_VAR\n"
               "POWER_UP INIT(Fast); " +
               positions +
               "; NEXT := Idle; END_POWER_UP\n"
               "STEP Idle: OWN ERROR; IF IN0 THEN POSITION(One); NEXT := Work; END_IF END_STEP\n"
               "STEP Work: OWN ERROR; IF INPOS AND NOT IN0 THEN POSITION(Two); NEXT := Idle; END_IF "
               "END_STEP\n"
               "END_PROGRAM\n";
    };
    for (const auto& [positions, one] :
         {std::pair("POSITIONS_ABSOLUTE", "One AT P1 := 1.1625 mm;"),
          std::pair("POSITIONS_RELATIVE_P_SOLL", "One AT P1 := 3333 counts; // 1.1625 mm")}) {
        const Compilation program = compile(source(positions));
        ASSERT_TRUE(program.ok) << test::shown(program, positions);
        const DecompileOptions options{.origin = {}, .motor = {}, .symbols = &program.symbols};
        const Decompilation result = decompiled(program.table, options);
        for (const char* part : {one, "Two AT P2 := 20 mm;"})
            EXPECT_TRUE(has(result, part)) << part << " in " << result.text;
        EXPECT_EQ(test::codes(compile(result.text)), test::codes(program));
    }
}

// 001 §6.1: one term of step 0, NEXT 1, and a term of step 1.
TEST(Decompile, WhatHasNoWordsIsBytesWithTheReason) {
    struct Row {
        Bytes term;
        const char* reason;
    };
    const Row rows[] = {
        {{0xC1, 0x04, 0x00, 0x01, 0x80, 0, 0, 0}, "INPUT has levels that CARE masks"},
        {{0xC1, 0, 0, 0x81, 0x80, 0, 0, 0}, "unused bits are set"},
        {{0xC1, 0, 0, 0x01, 0x80, 0x10, 0, 0}, "unused bits are set"},
        {{0xC1, 0, 0, 0x01, 0xC1, 0, 0, 0}, "it holds a command that is not sent"},
        {{0xC1, 0, 0, 0x41, 0x80, 0, 0, 0}, "CNT_TIME is set and nothing is preset"},
        {{0xC1, 0, 0, 0x3F, 0x80, 0, 0, 0}, "NEXT 63 is no step"},
        {{0xC1, 0, 0, 0x01, 0x7E, 0, 0, 0}, "the command changes how gateway and motor talk"},
        {{0xC1, 0, 0, 0x01, 0x78, 0, 0, 0}, "the command has no name"},
        {{0xC1, 0, 0x80, 0x00, 1, 0, 0, 0}, "register 0 cannot be written"},
        {{0xC1, 0, 0x80, 0x04, 1, 0, 0, 0}, "the motor has no register of this number"},
        {{0xC1, 0, 0x80, 0xC1, 1, 0, 0, 0}, "32 bits for a register of 16"},
        {{0xC1, 0, 0x80, 0x31, 1, 0, 0, 0}, "16 bits for a register of 32"},
        {{0xC1, 0, 0x80, 0x41, 1, 0, 1, 0}, "the upper word is not sent"},
        {{0xC1, 0, 0x80, 0x4D, 0, 4, 0, 0}, "the value is out of the register's range"},  // T1 1024, 0..1023
        {{0xFE, 0, 0, 0x01, 0x80, 0, 0, 0}, "the step cannot have a name"},
    };
    for (const Row& row : rows) {
        Bytes table = {0xC0, 0, 0, 0x01, 0x80, 0, 0, 0};
        table.insert(table.end(), row.term.begin(), row.term.end());
        const Decompilation result =
            decompiled(with_end(table), {.origin = {}, .motor = registers::Model::mac140});
        EXPECT_TRUE(has(result, std::string("// ") + row.reason)) << result.text;
        EXPECT_EQ(result.byte_terms, 1U) << row.reason;
        EXPECT_EQ(result.structured_steps, 1U) << row.reason;
    }
}

TEST(Decompile, ValuesInUnits) {
    const auto said = [](const Bytes& flex, registers::Model motor) {
        Bytes table = {0xC0, 0, 0, 0x01, 0x80, 0, 0, 0, 0xC1, 0x01, 0x81};
        table.insert(table.end(), flex.begin(), flex.end());
        return decompiled(with_end(table), {.origin = {}, .motor = motor});
    };
    using enum registers::Model;
    EXPECT_TRUE(has(said({0xB3, 0x00, 0xC0, 0, 0}, mac140), "P2 := 49152; // 12 rev"));
    EXPECT_TRUE(has(said({0x41, 0x4A, 0x0C, 0, 0}, mac140), "V1 := 3146; // 1500.1 rpm"));
    EXPECT_TRUE(has(said({0x41, 0xFE, 0xFF, 0, 0}, mac140), "V1 := -2;"));
    EXPECT_TRUE(has(said({0x4D, 0xFF, 0x03, 0, 0}, mac140), "T1 := 1023; // 100 %peak"));
    // L1 has 8 bits behind the point: 0180h is 1.5
    EXPECT_TRUE(has(said({0x51, 0x80, 0x01, 0, 0}, mac140), "L1 := 1.5;\n"));
    // FF41h is -191: / 256 = -0.74609375; -0.746 x 256 = -190.976 is the same, -0.75 x 256 is -192
    EXPECT_TRUE(has(said({0x51, 0x41, 0xFF, 0, 0}, mac140), "L1 := -0.746;\n"));
    // 013Ch is 316: 1.234 x 256 = 315.904 rounds to it, 1.23 x 256 = 314.88 does not
    EXPECT_TRUE(has(said({0x51, 0x3C, 0x01, 0, 0}, mac140), "L1 := 1.234;\n"));
    // 0001h: 0.0039 x 256 = 0.9984; 0.004 x 256 = 1.024 is 2.4 % off, which W002 would report
    EXPECT_TRUE(has(said({0x51, 0x01, 0x00, 0, 0}, mac140), "L1 := 0.0039;\n"));
    // 100 rpm is 277 on a MAC800 (004, register 5)
    EXPECT_TRUE(has(said({0xC1, 0x15, 0x01, 0, 0}, mac800), "V1 := 277; // 99.98 rpm"));
    // Register 116 is REC_CNT on MAC50-141; without --motor only 1..88 have names.
    EXPECT_TRUE(has(said({0x74, 0x05, 0, 0, 0}, mac140), "REC_CNT := 5;"));
    const Bytes table = with_end({0xC0, 0, 0, 0x01, 0x80, 0, 0, 0, 0xC1, 1, 0x81, 0x74, 5, 0, 0, 0});
    EXPECT_TRUE(has(decompiled(table), "REG(116) := 5;"));
}

TEST(Decompile, TheMotorThatFitsIsAssumed) {
    const Bytes mac800 = with_end({0xC0, 0, 0x80, 0xC1, 0x15, 1, 0, 0, 0xC0, 0, 0, 1, 0x80, 0, 0, 0});
    EXPECT_TRUE(has(decompiled(mac800), "MAC800 is assumed"));
    EXPECT_EQ(decompiled(mac800).byte_terms, 0U);
    const Bytes mac140 = with_end({0xC0, 0, 0x80, 0x41, 0x15, 1, 0, 0, 0xC0, 0, 0, 1, 0x80, 0, 0, 0});
    EXPECT_TRUE(has(decompiled(mac140), "MAC140 is assumed"));
    const Decompilation given = decompiled(mac800, {.origin = {}, .motor = registers::Model::mac95});
    EXPECT_TRUE(has(given, "MOTOR MAC95;"));
    EXPECT_FALSE(has(given, "assumed"));
    EXPECT_EQ(given.byte_terms, 1U);
}

TEST(Decompile, GivenNamesAreUsedIfTheyAreNames) {
    Symbols symbols;
    symbols.program = "Press";
    symbols.steps[0] = "POWER_UP";  // a word of the language
    symbols.steps[1] = "Idle";
    symbols.steps[2] = "idle";  // the same name
    symbols.inputs = {"Start", "IN1", "OUT7", "V1", "start", "a b"};
    symbols.outputs = {"Lamp", "OUT1", "", "Start"};
    const Bytes table = with_end({0xC0, 0, 0, 0x01, 0x80, 0x0F, 0, 0,  //
                                  0xC1, 0x3F, 0x3F, 0x02, 0x80, 0, 0, 0});
    const Decompilation result = decompiled(table, {.origin = {}, .motor = {}, .symbols = &symbols});
    EXPECT_TRUE(has(result, "PROGRAM Press\n"));
    EXPECT_TRUE(has(result,
                    "    Start AT IN0 : BOOL;\n    I2 AT IN2 : BOOL;\n    I3 AT IN3 : BOOL;\n    I4 AT IN4 "
                    ": BOOL;\n    I5 AT IN5 : BOOL;\n"))
        << result.text;
    EXPECT_TRUE(has(result, "STEP Idle:\n    OUT Lamp, OUT1, Q2, Q3;\n")) << result.text;
    EXPECT_TRUE(has(result, "IF Start AND IN1 AND I2 AND I3 AND I4 AND I5 THEN\n        NEXT := S2;"));
    EXPECT_FALSE(has(result, "made up"));
}

TEST(Decompile, HeadSaysWhereItCameFromAndHow) {
    const Bytes table =
        with_end({0xC0, 0,    0,    0x01, 0x80, 0, 0, 0, 0xC1, 0x01, 0x01, 0x02, 0x80, 0, 0, 0,  //
                  0xC2, 0x01, 0x01, 0x01, 0x80, 0, 0, 0, 0xC2, 0x02, 0x02, 0x02, 0xE5, 0, 0, 0});
    const Decompilation result = decompiled(table, {.origin = "old\nSTEP (*.bin", .motor = {}});
    EXPECT_TRUE(result.text.starts_with(
        "// Decompiled from old?STEP (*.bin: 4 terms and the end of the table.\n"
        "// Steps: 2 as branches, 0 as branches and TERMs, 1 as TERMs. TERMs: 1 in symbols, 1 as bytes.\n"))
        << result.text;
    EXPECT_TRUE(has(result, "PROGRAM Table\n"));
    EXPECT_TRUE(has(decompiled(table, {.origin = "old_press.bin", .motor = {}}), "PROGRAM old_press\n"));
}

TEST(Decompile, EndTermsAndWhatFollowsThem) {
    EXPECT_TRUE(has(decompiled({0x3F, 0, 0, 0, 0, 0, 0, 0}), "TERM 16#3F"));
    EXPECT_TRUE(has(decompiled({0xC0, 0, 0, 0, 0x80, 0, 0, 0, 0xFF, 1, 2, 3, 4, 5, 6, 7}),
                    "TERM 16#FF, 16#01, 16#02, 16#03, 16#04, 16#05, 16#06, 16#07; // end of the table\n"));
    const Bytes longer = {0x3F, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3};
    EXPECT_EQ(decompile(longer, {}).trailing_bytes, 3U);
    EXPECT_NE(decompile({}, {}).error, "");
    EXPECT_NE(decompile(Bytes(16, 0xC0), {}).error, "");
    EXPECT_NE(decompile(Bytes{0x3F, 0, 0}, {}).error, "");
}

// Cases that the compiler refuses as branches, so that they must be TERMs: what was tried first is not shown.
TEST(Decompile, WhatTheCompilerRefusesBecomesTerms) {
    // POSITION(A1) = 50h in step 0, where the motor may be in INIT: E052 as a branch.
    const Decompilation refused = decompiled(with_end({0xC0, 0x01, 0x01, 0x01, 0x50, 0, 0, 0}));
    EXPECT_TRUE(has(refused, "TERM IF I0 THEN POSITION(A1); NEXT := S1; END_IF;")) << refused.text;
    // The same in what ON ERROR would do: 1 and 2 go to 3 with it.
    const Decompilation entry = decompiled(with_end({0xC0, 0,    0, 0x01, 0x80, 0, 0, 0,  //
                                                     0xC1, 0x80, 0, 0x03, 0x50, 0, 0, 0,  //
                                                     0xC2, 0x80, 0, 0x03, 0x50, 0, 0, 0}));
    EXPECT_FALSE(has(entry, "ON ERROR")) << entry.text;
    EXPECT_EQ(entry.byte_terms, 0U);
}

TEST(Decompile, StepZeroThatShowsSomething) {
    // Step 0 writes OUT1 (2) whatever happens: not POWER_UP. 001 §6.1.9: nothing enters it at power-up.
    const Decompilation result = decompiled(with_end({0xC0, 0,    0,    0x3E, 0x80, 2, 0, 0,  //
                                                      0xC0, 0x80, 0,    0x3E, 0x80, 2, 0, 0,  //
                                                      0xC0, 0x01, 0x01, 0x01, 0x80, 0, 0, 0}));
    EXPECT_EQ(first_step(result),
              "STEP S0 AT 0:\n    OUT Q1;\n    OWN ERROR;\n    IF I0 THEN\n        NEXT := S1;\n"
              "    END_IF\n")
        << result.text;
    const Decompilation only_named = decompiled(with_end({0xC5, 0, 0, 0x3E, 0x80, 0, 0, 0}));
    EXPECT_TRUE(has(only_named, "STEP S0 AT 0: // the table only names it\n")) << only_named.text;
    EXPECT_TRUE(has(only_named, "STEP S5 AT 5:\n"));
}

TEST(Decompile, BranchesThatATimerDecides) {
    // 44h: timer 0; 04h: both 0. The last true term wins, so the shorter condition is written second.
    const Decompilation result = decompiled(with_end({0x44, 0, 0, 0x01, 0x80, 0, 0, 0,  //
                                                      0x04, 0, 0, 0x02, 0x80, 0, 0, 0}));
    EXPECT_TRUE(has(result,
                    "    IF TIMER.Q AND COUNTER.Q THEN\n        NEXT := S2;\n    ELSIF TIMER.Q THEN\n"
                    "        NEXT := S1;\n    END_IF\n") ||
                has(result, "TERM"))
        << result.text;
    // In 0 goes on, but not when the timer is at 0: taken back by a NEXT to the own step in every such case.
    const Decompilation back = decompiled(with_end({0xC4, 0x01, 0x01, 0x01, 0x80, 0, 0, 0,  //
                                                    0x44, 0, 0, 0x04, 0x80, 0, 0, 0}));
    EXPECT_TRUE(has(back, "IF I0 AND NOT TIMER.Q THEN\n        NEXT := S1;\n    END_IF\n")) << back.text;
    // The same where in 0 is asked for both times: that is two branches.
    const Decompilation said = decompiled(with_end({0xC4, 0x01, 0x01, 0x01, 0x80, 0, 0, 0,  //
                                                    0x44, 0x01, 0x01, 0x04, 0x80, 0, 0, 0}));
    EXPECT_TRUE(
        has(said, "IF I0 AND TIMER.Q THEN\n        NEXT := S4;\n    ELSIF I0 THEN\n        NEXT := S1;\n"))
        << said.text;
}

}  // namespace
}  // namespace nplc::seqc
