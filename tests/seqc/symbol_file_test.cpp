#include "seqc/symbol_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/crc32.h"
#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::json;

const char* const kBlink =
    "PROGRAM Blink\n"                                         // 1
    "MOTOR MAC141; SCALE 2 rev = 5.5 mm;\n"                   // 2
    "VAR_INPUT Go AT %IX0.1 : BOOL; END_VAR\n"                // 3
    "VAR_OUTPUT Lamp AT %QX0.2 : BOOL; END_VAR\n"             // 4
    "VAR_MOTOR Home AT P1 := -8; Fast AT REG(65); END_VAR\n"  // 5
    "STEP Off: OWN ERROR;\n"                                  // 6
    "    IF Go THEN NEXT := Lit; END_IF\n"                    // 7
    "END_STEP\n"                                              // 8
    "STEP Lit: OWN ERROR; OUT Lamp;\n"                        // 9
    "    IF NOT Go THEN NEXT := Off; END_IF\n"                // 10
    "END_STEP\n"
    "END_PROGRAM\n";

Compilation blink() {
    Compilation compilation = compile(kBlink);
    EXPECT_TRUE(compilation.ok);
    return compilation;
}

std::string blink_symbols() {
    return write_symbols(blink(), kBlink, "here/blink.seq");
}

TEST(SymbolFileWriting, HoldsWhichTimersAreLimits) {
    const std::string text =
        "PROGRAM P\nMOTOR MAC140;\n"
        "STEP S: OWN ERROR; IF IN0 WITHIN T#2s THEN NEXT := T; ELSE NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; ENTRY TIMER := T#1s; IF TIMER.Q THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
    const Compilation compilation = compile(text);
    ASSERT_TRUE(compilation.ok);
    EXPECT_EQ(compilation.symbols.timer_is_limit, std::uint64_t{1} << 1);
    std::string written = write_symbols(compilation, text, "p.seq");
    EXPECT_EQ(read_symbols(written).file.symbols, compilation.symbols);
    // As older ones were written
    const std::string member = ",\"timer_is_limit\":true";
    ASSERT_NE(written.find(member), std::string::npos) << written;
    written.erase(written.find(member), member.size());
    const SymbolReading old = read_symbols(written);
    EXPECT_EQ(old.error, "");
    EXPECT_EQ(old.file.symbols.timer_is_limit, 0U);
}

TEST(SymbolFileWriting, HoldsWhatTheProgramSays) {
    const Compilation compilation = blink();
    const Json file = Json::parse(blink_symbols());
    EXPECT_EQ(file["format"], "nanoplc-symbols");
    EXPECT_EQ(file["version"], 1);
    EXPECT_EQ(file["program"], "Blink");
    EXPECT_EQ(file["source"], "here/blink.seq");
    EXPECT_EQ(file["motor"], "MAC141");
    EXPECT_EQ(file["scale"], Json::parse(R"({"revolutions": 2, "length": 5.5, "unit": "mm"})"));
    EXPECT_EQ(file["inputs"], Json::parse(R"(["IN0", "Go", "IN2", "IN3", "IN4", "IN5"])"));
    EXPECT_EQ(file["outputs"], Json::parse(R"(["OUT0", "OUT1", "Lamp", "OUT3"])"));
    // P1 is register 49 and V1 register 65 (001 §3.2); Lamp is bit 2, 4.
    EXPECT_EQ(file["registers"],
              Json::parse(R"([{"name": "Home", "register": "P1", "number": 49, "initial": -8},
                                                 {"name": "Fast", "register": "V1", "number": 65}])"));
    EXPECT_EQ(file["steps"], Json::parse(R"([{"number": 0, "name": "POWER_UP", "line": 0, "outputs": 0},
                                             {"number": 1, "name": "Off", "line": 6, "outputs": 0},
                                             {"number": 2, "name": "Lit", "line": 9, "outputs": 4}])"));
    EXPECT_EQ(file["table"]["bytes"], compilation.table.size());
    EXPECT_EQ(file["table"]["terms"], compilation.table.size() / 8);
    EXPECT_EQ(file["table"]["crc32"], fmt::format("{:08X}", base::crc32(compilation.table)));
}

TEST(SymbolFileWriting, SaysWhereEachTermComesFrom) {
    const std::vector<std::uint8_t> table = blink().table;
    const Json terms = Json::parse(blink_symbols())["terms"];
    ASSERT_EQ(terms.size(), table.size() / 8);
    const Json none = Json::parse(R"({"line": 0, "column": 0})");
    // "    IF Go THEN NEXT": NEXT is the 16th character; one more letter and NOT with its blank: the 20th.
    const Json go = Json::parse(R"({"line": 7, "column": 16})");
    const Json not_go = Json::parse(R"({"line": 10, "column": 20})");
    int switches = 0;
    for (std::size_t i = 0; i + 1 < terms.size(); ++i) {
        const int step = table[i * 8] & 0x3F;
        if (step == 0) continue;
        EXPECT_EQ(terms[i], step == 1 ? go : not_go) << i;
        ++switches;
    }
    EXPECT_EQ(switches, 2);
    EXPECT_EQ(terms.back(), none) << "the end term";
}

TEST(SymbolFileWriting, FileNamesNeedNotBeUtf8) {
    const std::string text = write_symbols(blink(), kBlink, "a\xFF\"\n.seq");
    EXPECT_EQ(read_symbols(text).error, "");
}

TEST(SymbolFileReading, GivesBackWhatWasWritten) {
    const Compilation compilation = blink();
    const SymbolReading reading = read_symbols(blink_symbols(), compilation.table);
    ASSERT_EQ(reading.error, "");
    EXPECT_EQ(reading.file.symbols, compilation.symbols);
    EXPECT_EQ(reading.file.source, "here/blink.seq");
    EXPECT_EQ(reading.file.step_lines[2], 9U);
    EXPECT_EQ(reading.file.step_outputs[2], 4U);
    EXPECT_EQ(reading.file.terms.size(), compilation.table.size() / 8);
    EXPECT_EQ(reading.file.terms.back().line, 0U);
}

TEST(SymbolFileReading, GivesBackTheExamples) {
    int examples = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SEQC_EXAMPLES)) {
        if (entry.path().extension() != ".seq") continue;
        std::stringstream source;
        source << std::ifstream(entry.path()).rdbuf();
        const Sources sources = read_sources(entry.path().string(), source.str());
        const Compilation compilation = compile(sources);
        const SymbolReading reading = read_symbols(write_symbols(compilation, sources), compilation.table);
        EXPECT_EQ(reading.error, "") << entry.path();
        EXPECT_EQ(reading.file.symbols, compilation.symbols) << entry.path();
        ++examples;
    }
    EXPECT_GE(examples, 3);
}

TEST(SymbolFileReading, GivesBackGroups) {
    const std::string source =
        "PROGRAM P MOTOR MAC140; CONST Pause := T#1s500ms; CONST Far := 3 rev; GROUP Both: S, T; GROUP Last: "
        "T; ON IN5 IN Both NEXT := U; ON IN4 IN Last "
        "NEXT := U;\n"
        "STEP S: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP STEP T: OWN ERROR; IF IN1 THEN NEXT := S; "
        "END_IF END_STEP\n"
        "STEP U: OWN ERROR; IF IN2 THEN NEXT := S; END_IF END_STEP END_PROGRAM";
    const Compilation compilation = compile(source);
    const std::vector<StepGroup> groups = {{"Both", 0b110}, {"Last", 0b100}};
    EXPECT_EQ(compilation.symbols.groups, groups);
    Json file = Json::parse(write_symbols(compilation, source, "p.seq"));
    EXPECT_EQ(read_symbols(file.dump()).file.symbols.groups, groups);
    EXPECT_EQ(read_symbols(file.dump()).file.symbols.times, (std::vector<NamedTime>{{"Pause", 1500}}));
    file["groups"][1]["steps"][0] = 63;
    EXPECT_EQ(read_symbols(file.dump()).error.find("groups[1].steps[0]: this must be a whole number"), 0U);
}

TEST(SymbolFileReading, GivesBackEveryRegister) {
    for (const auto model : {registers::Model::mac50, registers::Model::mac140, registers::Model::mac800}) {
        std::string source = fmt::format("PROGRAM P MOTOR {}; VAR_MOTOR\n", registers::name_of(model));
        std::vector<std::int64_t> smallest;
        for (const auto& reg : registers::map_of(model)) {
            if (reg.number == 0 || reg.number > 127) continue;
            const auto bits = static_cast<std::uint32_t>(reg.min);
            source += fmt::format("N{0} AT REG({0}) := 16#{1:X};\n", reg.number,
                                  registers::is_32_bit(reg.format) ? bits : bits & 0xFFFFU);
            smallest.push_back(reg.min);
        }
        source += "END_VAR STEP S: OWN ERROR; END_STEP END_PROGRAM";
        const Compilation compilation = compile(source);
        ASSERT_TRUE(compilation.ok) << compilation.diagnostics.front().message << source;
        const SymbolReading reading = read_symbols(write_symbols(compilation, source, "p.seq"));
        EXPECT_EQ(reading.error, "");
        const std::vector<MotorName>& names = reading.file.symbols.motor_names;
        ASSERT_EQ(names.size(), smallest.size());
        for (std::size_t i = 0; i < names.size(); ++i)
            EXPECT_EQ(names[i].initial, smallest[i]) << names[i].reg;
        EXPECT_EQ(reading.file.symbols, compilation.symbols);
    }
}

TEST(SymbolFileReading, ATableOfTermsHasNoSteps) {
    const std::string source = "PROGRAM T TERM 16#C0, 0, 0, 1, 16#80, 0, 0, 0; END_PROGRAM";
    const Compilation compilation = compile(source);
    const SymbolReading reading = read_symbols(write_symbols(compilation, source, "t"), compilation.table);
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.file.symbols, compilation.symbols);
    EXPECT_EQ(reading.file.terms[0].line, 1U);
    EXPECT_EQ(reading.file.terms[0].column, 11U);
}

TEST(SymbolFileReading, UnknownMembersAreReadOver) {
    Json file = Json::parse(blink_symbols());
    file["checked_by"] = {{"name", "me"}};
    file["steps"][0]["comment"] = 7;
    EXPECT_EQ(read_symbols(file.dump()).error, "");
}

TEST(SymbolFileReading, AnotherTablesSymbolsDoNotFit) {
    std::vector<std::uint8_t> table = blink().table;
    table[0] ^= 0x40;
    EXPECT_NE(read_symbols(blink_symbols(), table).error.find("it belongs to another table"),
              std::string::npos);
    table = blink().table;
    table.insert(table.end(), 8, 0xFF);
    EXPECT_NE(read_symbols(blink_symbols(), table).error.find("it belongs to another table"),
              std::string::npos);
}

struct Bad {
    std::string path;  ///< JSON pointer
    std::string value;
    std::string says;
};

class SymbolFileMistake : public testing::TestWithParam<Bad> {};

TEST_P(SymbolFileMistake, IsToldWithItsPlace) {
    Json file = Json::parse(blink_symbols());
    file[Json::json_pointer(GetParam().path)] = Json::parse(GetParam().value);
    EXPECT_NE(read_symbols(file.dump()).error.find(GetParam().says), std::string::npos)
        << read_symbols(file.dump()).error;
}

INSTANTIATE_TEST_SUITE_P(
    All, SymbolFileMistake,
    testing::Values(
        Bad{"", "[]", "this is no symbol file"}, Bad{"", "3", "this is no symbol file"},
        Bad{"/format", "\"elf\"", "this is no symbol file"},
        Bad{"/format", "1", "format: this must be a text"},
        Bad{"/version", "3", "version 3 was written by a newer seqc; this one reads version 2"},
        Bad{"/version", "0", "version: this must be a whole number, 1 to"},
        Bad{"/version", "\"1\"", "version: this must be a whole number"},
        Bad{"/program", "\"Two words\"", "program: this is no name"},
        Bad{"/program", "\"a\\nTERM\"", "program: this is no name"},
        Bad{"/program", "\"\"", "program: this is no"},
        Bad{"/program", "null", "program: this must be a text"},
        Bad{"/source", "1", "source: this must be a text"},
        Bad{"/motor", "\"MAC999\"", "motor: the motors are MAC50"},
        Bad{"/scale/length", "0", "scale.length: this must be a number above 0"},
        Bad{"/scale", "5", "scale: this must be an object"},
        Bad{"/scale/unit", "\"m m\"", "scale.unit: this is no name"},
        Bad{"/table", "null", "table: this must be an object"},
        Bad{"/table/bytes", "-8", "table.bytes: this must be a whole number"},
        Bad{"/table/bytes", "18446744073709551615", "table.bytes: this must be a whole number"},
        Bad{"/table/bytes", "1.5", "table.bytes: this must be a whole number"},
        Bad{"/table/terms", "2", "table.terms: 2 terms are not"},
        Bad{"/table/crc32", "\"1234567\"", "table.crc32: this must be a text of 8 hex digits"},
        Bad{"/table/crc32", "\"1234567G\"", "table.crc32: this must be a text of 8 hex digits"},
        Bad{"/table/crc32", "1", "table.crc32: this must be a text"},
        Bad{"/steps", "{}", "steps: this must be a list"},
        Bad{"/steps/1", "7", "steps[1]: this must be an object"},
        Bad{"/steps/1", "{}", "steps[1].number is missing"},
        Bad{"/steps/1/number", "63", "steps[1].number: this must be a whole number, 0 to 62"},
        Bad{"/steps/1/number", "2", "steps[2].number: this step stands twice"},
        Bad{"/steps/1/name", "\"LIT\"", "steps[2].name: 'Lit' stands twice"},
        Bad{"/steps/1/name", "\"POWER_UP\"", "steps[1].name: 'POWER_UP' is a word of the language"},
        Bad{"/steps/1/name", "\"9\"", "steps[1].name: this is no name"},
        Bad{"/steps/1/outputs", "16", "steps[1].outputs: this must be a whole number, 0 to 15"},
        Bad{"/steps/1/line", "-1", "steps[1].line: this must be a whole number"},
        Bad{"/inputs", "[\"A\"]", "inputs: there must be 6 names"},
        Bad{"/outputs", "3", "outputs: this must be a list"},
        Bad{"/inputs/2", "\"IF\"", "inputs[2]: 'IF' is a word of the language"},
        Bad{"/outputs/0", "\"go\"", "outputs[0]: 'go' stands twice"},
        Bad{"/registers/0/number", "128", "registers[0].number: this must be a whole number, 1 to 127"},
        Bad{"/registers/0/initial", "4294967296", "registers[0].initial: this must be a whole number"},
        Bad{"/registers/0/name", "\"Lamp\"", "registers[0].name: 'Lamp' stands twice"},
        Bad{"/units/0/number", "0", "units[0].number: this must be a whole number, 1 to 127"},
        Bad{"/units/0/unit", "7", "units[0].unit: this must be a text"},
        Bad{"/terms/0/line", "\"x\"", "terms[0].line: this must be a whole number"},
        Bad{"/terms/0", "[1, 2]", "terms[0]: this must be an object"},
        Bad{"/terms", "[]", "terms: there must be"}));

TEST(SymbolFileReading, EveryMemberButScaleAndUnitsIsNeeded) {
    const Json whole = Json::parse(blink_symbols());
    for (const auto& [name, value] : whole.items()) {
        Json file = whole;
        file.erase(name);
        const std::string error = read_symbols(file.dump()).error;
        EXPECT_EQ(error.empty(), name == "scale" || name == "units") << name << ": " << error;
    }
}

TEST(SymbolFileReading, WhatIsNoJson) {
    EXPECT_NE(read_symbols("").error.find("this is not JSON"), std::string::npos);
    EXPECT_NE(read_symbols("{\n  \"format\" 1}").error.find("not JSON, from line 2, column 12 on"),
              std::string::npos)
        << read_symbols("{\n  \"format\" 1}").error;
    EXPECT_NE(read_symbols(std::string("\xFF\0", 2)).error.find("this is not JSON"), std::string::npos);
    EXPECT_NE(read_symbols(std::string(1'000'000, '[')).error.find("this is not JSON"), std::string::npos);
    const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
    EXPECT_NE(read_symbols(deep).error.find("this is no symbol file"), std::string::npos);
    const std::string whole = blink_symbols();
    for (std::size_t length = 0; length + 2 < whole.size(); ++length)
        EXPECT_NE(read_symbols(whole.substr(0, length)).error, "") << length;
}

TEST(SymbolFileName, BesideTheTable) {
    EXPECT_EQ(symbol_file_beside("a/b.bin"), "a/b.sym");
    EXPECT_EQ(symbol_file_beside("b"), "b.sym");
    EXPECT_EQ(symbol_file_beside("b.sym"), "");
}

}  // namespace
}  // namespace nplc::seqc
