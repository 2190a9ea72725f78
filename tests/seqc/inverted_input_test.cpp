// Estop AT NOT IN2: what goes by the name goes by its sense, and the table has the wire. Expected tables are
// those of the same program with Well AT IN2 and NOT Well, or bytes by 001 §6.1.5.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/graph/graph_model.h"
#include "report/table_diff.h"
#include "seqc/conditions.h"
#include "seqc/decompile.h"
#include "seqc/format.h"
#include "seqc/properties.h"
#include "seqc/symbol_file.h"
#include "support.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::json;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// All forms that test an input; % stands for the one at IN2.
const char* const kBody =
    "VAR_OUTPUT Run AT OUT0; Horn AT OUT1; END_VAR\n"
    "ON ERROR NEXT := Fault;\n"
    "GROUP Both: Work, Wait;\n"
    "ON % AND INPOS IN Both EXCEPT Wait NEXT := Halt;\n"
    "ON % XOR Start EXCEPT Work, Wait, Idle, Held NEXT := Halt;\n"
    "SEQUENCE Close(VAR_INPUT Told) STEP First: OWN ERROR; IF NOT Told THEN RETURN; END_IF END_STEP "
    "END_SEQUENCE\n"
    "STEP Idle: IF Start AND NOT % THEN CALL Close(@); NEXT := Work; END_IF END_STEP\n"
    "STEP Work: OUT Run; OUT Horn WHEN %; IF % AND COUNTER.Q THEN NEXT := Wait; END_IF END_STEP\n"
    "STEP Wait: IF % FOR T#20ms THEN NEXT := Idle; END_IF END_STEP\n"
    "STEP Held: IF % WITHIN T#1s THEN NEXT := Idle; ELSE NEXT := Halt; END_IF END_STEP\n"
    "STEP Halt: OWN ERROR; TERM IF NOT % AND Start THEN NEXT := Held; END_IF; END_STEP\n"
    "STEP Fault: OWN ERROR; IF ANY ERROR AND % THEN NEXT := Idle; END_IF END_STEP\n"
    "END_PROGRAM\n";

std::string with_inverted(const std::string& body) {
    return "PROGRAM P MOTOR MAC140; VAR_INPUT Start AT IN0; Estop AT NOT IN2 : BOOL; END_VAR\n" +
           replaced(replaced(body, "%", "Estop"), "@", "Start");
}

std::string with_wire(const std::string& body) {
    std::string text = replaced(replaced(body, "TERM IF NOT %", "TERM IF Well"), "%", "(NOT Well)");
    return "PROGRAM P MOTOR MAC140; VAR_INPUT Start AT IN0; Well AT IN2 : BOOL; END_VAR\n" +
           replaced(text, "@", "Start");
}

TEST(InvertedInput, TheTableIsThatOfTheWire) {
    EXPECT_EQ(test::compiled(with_inverted(kBody)).table, test::compiled(with_wire(kBody)).table);
}

TEST(InvertedInput, AnArgumentGoesByItsName) {
    const auto called = [](const std::string& input, const std::string& condition, const std::string& given) {
        return test::compiled(
                   "PROGRAM P MOTOR MAC140; VAR_INPUT " + input +
                   " END_VAR SEQUENCE Await(VAR_INPUT Told) STEP First: OWN ERROR; IF " + condition +
                   " THEN RETURN; END_IF END_STEP END_SEQUENCE STEP S: OWN ERROR; IF IN0 THEN CALL "
                   "Await(" +
                   given + "); NEXT := S; END_IF END_STEP END_PROGRAM\n")
            .table;
    };
    const auto of_wire = called("Well AT IN2;", "NOT Told", "Well");
    EXPECT_EQ(called("Estop AT NOT IN2;", "Told", "Estop"), of_wire);
    EXPECT_EQ(called("Estop AT NOT IN2;", "NOT Told", "IN2"), of_wire);
}

std::string step_with(const std::string& inputs, const std::string& branch) {
    return "PROGRAM P MOTOR MAC140; VAR_INPUT " + inputs + " END_VAR STEP S: OWN ERROR; IF " + branch +
           " THEN NEXT := T; END_IF END_STEP STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP "
           "END_PROGRAM\n";
}

TEST(InvertedInput, AnAddressIsTheWire) {
    // INPUT and CARE of step 1, the second term
    const std::string inverted = "Estop AT NOT IN2 : BOOL;";
    EXPECT_EQ(test::term_text(test::compiled(step_with(inverted, "Estop")).table, 1),
              "C1 00 04 02 80 00 00 00");
    EXPECT_EQ(test::term_text(test::compiled(step_with(inverted, "NOT Estop")).table, 1),
              "C1 04 04 02 80 00 00 00");
    EXPECT_EQ(test::term_text(test::compiled(step_with(inverted, "IN2")).table, 1),
              "C1 04 04 02 80 00 00 00");
    EXPECT_EQ(test::term_text(test::compiled(step_with(inverted, "%IX0.2")).table, 1),
              "C1 04 04 02 80 00 00 00");
    EXPECT_EQ(test::term_text(test::compiled(step_with("Estop AT NOT %IX0.2;", "Estop")).table, 1),
              "C1 00 04 02 80 00 00 00");
}

TEST(InvertedInput, ItsEdgesAreThoseOfItsName) {
    const std::string inverted = "Estop AT NOT IN2;";
    const Compilation rising = test::compiled(step_with(inverted, "R_TRIG(Estop)"));
    const Compilation falling = test::compiled(step_with(inverted, "F_TRIG(Estop)"));
    EXPECT_EQ(rising.table, test::compiled(step_with("Well AT IN2;", "F_TRIG(Well)")).table);
    EXPECT_EQ(falling.table, test::compiled(step_with("Well AT IN2;", "R_TRIG(Well)")).table);
    EXPECT_EQ(rising.symbols.steps[3], "S_Estop_off");
    EXPECT_EQ(rising.symbols.made_for[3], "copy of 'S' for: Estop was off");
    EXPECT_EQ(falling.symbols.steps[3], "S_Estop_on");
}

TEST(InvertedInput, OneEdgeUnderTwoNamesIsOneEdge) {
    const Compilation both = test::compiled(step_with("Estop AT NOT IN2;", "R_TRIG(Estop) OR F_TRIG(IN2)"));
    EXPECT_EQ(both.table, test::compiled(step_with("Well AT IN2;", "F_TRIG(Well)")).table);
}

TEST(InvertedInput, AnOutputIsNeverOne) {
    const std::string source =
        "PROGRAM P VAR_OUTPUT Valve AT NOT OUT1 : BOOL; END_VAR STEP S: OWN ERROR; OUT Valve; END_STEP "
        "END_PROGRAM";
    const Compilation result = compile(source);
    EXPECT_EQ(test::codes(result), "E022");
    ASSERT_FALSE(result.diagnostics.empty());
    EXPECT_EQ(source.substr(result.diagnostics[0].span.offset, result.diagnostics[0].span.length), "NOT");
}

TEST(InvertedInput, NotStandsOnceAndForAnInput) {
    for (const char* block :
         {"VAR_INPUT Estop AT NOT NOT IN2; END_VAR", "VAR_INPUT NOT Estop AT IN2; END_VAR",
          "VAR_INPUT Estop AT NOT; END_VAR", "VAR_MOTOR Fast AT NOT V1; END_VAR"}) {
        const Compilation result = compile(std::string("PROGRAM P MOTOR MAC140; ") + block +
                                           " STEP S: OWN ERROR; END_STEP END_PROGRAM");
        EXPECT_FALSE(result.ok) << block;
    }
}

TEST(InvertedInput, TextsOfTheTableSpeakOfTheName) {
    const std::string source = step_with("Estop AT NOT IN2;", "Estop");
    const Compilation result = test::compiled(source);
    for (const std::string& text :
         {listing(result, source, "p.seq"), disassemble(result.table, "P", &result.symbols).text}) {
        EXPECT_EQ(text.find("NOT Estop"), std::string::npos) << text;
        EXPECT_NE(text.find("Estop"), std::string::npos) << text;
    }
}

TEST(InvertedInput, AConflictIsShownByTheName) {
    const std::string source =
        "PROGRAM P VAR_INPUT A AT IN0; Estop AT NOT IN2; END_VAR STEP S: OWN ERROR; IF A THEN NEXT := T; "
        "END_IF "
        "IF Estop THEN NEXT := U; END_IF END_STEP STEP T: OWN ERROR; END_STEP STEP U: OWN ERROR; END_STEP "
        "END_PROGRAM";
    const Compilation result = compile(source);
    EXPECT_NE(test::shown(result, source).find("A = 1, Estop = 1"), std::string::npos)
        << test::shown(result, source);
}

TEST(InvertedInput, TheSymbolFileHasItsSense) {
    const std::string source = step_with("Start AT IN0; Estop AT NOT IN2;", "Estop OR Start");
    const Compilation result = test::compiled(source);
    EXPECT_EQ(result.symbols.inverted_inputs, 0x04);
    const std::string text = write_symbols(result, source, "p.seq");
    const Json file = Json::parse(text);
    EXPECT_EQ(file["version"], 2);
    EXPECT_EQ(file["inputs"][2], "Estop");
    EXPECT_EQ(file["inverted_inputs"], Json::parse("[2]"));
    const SymbolReading reading = read_symbols(text);
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(reading.file.symbols, result.symbols);

    const std::string plain = step_with("Estop AT IN2;", "Estop");
    const Json without = Json::parse(write_symbols(test::compiled(plain), plain, "p.seq"));
    EXPECT_EQ(without["version"], 1);
    EXPECT_FALSE(without.contains("inverted_inputs"));
}

TEST(InvertedInput, ASymbolFileWithAWrongOneIsRefused) {
    const std::string source = step_with("Estop AT NOT IN2;", "Estop");
    Json file = Json::parse(write_symbols(test::compiled(source), source, "p.seq"));
    file["inverted_inputs"] = {6};
    EXPECT_EQ(read_symbols(file.dump()).error, "inverted_inputs[0]: this must be a whole number, 0 to 5");
    file["inverted_inputs"] = {3};
    EXPECT_EQ(read_symbols(file.dump()).error,
              "inverted_inputs[0]: the name IN3 is the input itself and cannot be inverted");
    file["inverted_inputs"] = "2";
    EXPECT_EQ(read_symbols(file.dump()).error, "inverted_inputs: this must be a list");
}

DecompileOptions named(const Compilation& result) {
    DecompileOptions options;
    options.symbols = &result.symbols;
    return options;
}

TEST(InvertedInput, ComesBackFromTheTable) {
    const Compilation result = test::compiled(with_inverted(kBody));
    const Decompilation back = decompile(result.table, named(result));
    EXPECT_EQ(back.error, "");
    EXPECT_NE(back.text.find("    Estop AT NOT IN2 : BOOL;\n"), std::string::npos) << back.text;
    const Compilation again = compile(back.text);
    EXPECT_EQ(again.table, result.table) << test::shown(again, back.text) << back.text;
    EXPECT_EQ(format_program(back.text).text, back.text);
}

TEST(InvertedInput, ComesBackWithItsConditions) {
    const Compilation result =
        test::compiled(step_with("Start AT IN0; Estop AT NOT IN2;", "Start AND NOT Estop"));
    const std::string text = decompile(result.table, named(result)).text;
    EXPECT_NE(text.find("IF Start AND NOT Estop THEN"), std::string::npos) << text;
}

TEST(InvertedInput, ADrawingHasTheConditionsByNameAndTheWireAtTheTerminal) {
    const std::string source = step_with("Estop AT NOT IN2;", "Estop");
    const Compilation result = test::compiled(source);
    const GraphModel model = graph_model_of(result.table, &result.symbols, "p", {&result.written, source});
    ASSERT_EQ(model.terminals.size(), 1U);
    EXPECT_EQ(model.terminals[0], (std::pair<std::string, std::string>("IN2", "NOT Estop")));
    const GraphModel of_table = graph_model_of(result.table, &result.symbols, "p", {});
    ASSERT_EQ(of_table.boxes.size(), 3U);
    ASSERT_EQ(of_table.boxes[1].ways.size(), 1U);
    EXPECT_EQ(of_table.boxes[1].ways[0].condition, "Estop");
}

TEST(InvertedInput, ADifferenceIsToldInTheNewNames) {
    const Compilation before = test::compiled(step_with("Well AT IN2; Go AT IN3;", "NOT Well"));
    const Compilation same = test::compiled(step_with("Estop AT NOT IN2; Go AT IN3;", "Estop"));
    EXPECT_TRUE(diff_of({before.table, &before.symbols}, {same.table, &same.symbols}).same_behaviour());
    const Compilation other = test::compiled(step_with("Estop AT NOT IN2; Go AT IN3;", "Estop AND Go"));
    const std::string text = text_of(diff_of({before.table, &before.symbols}, {other.table, &other.symbols}));
    EXPECT_NE(text.find("Estop AND NOT Go"), std::string::npos) << text;
}

TEST(InvertedInput, AFormattedDeclarationKeepsIt) {
    const std::string text =
        format_program(
            "PROGRAM P VAR_INPUT\nStart at in0 : bool;\nEstop  at not in2:bool;\nEND_VAR "
            "STEP S: OWN ERROR; END_STEP END_PROGRAM")
            .text;
    EXPECT_NE(text.find("    Start AT IN0     : BOOL;\n    Estop AT NOT IN2 : BOOL;\n"), std::string::npos)
        << text;
}

TEST(InvertedInput, PropertiesAndAssumptionsGoByTheName) {
    const Compilation result = test::compiled(step_with("Start AT IN0; Estop AT NOT IN2;", "Estop OR Start"));
    const auto holds_in = [&](const std::string& condition, std::uint8_t image) {
        const PropertyReading reading =
            read_properties("PROPERTY A: NEVER " + condition + ";", result.symbols);
        EXPECT_TRUE(reading.diagnostics.empty()) << condition;
        return !reading.properties.empty() && holds(reading.properties[0].condition, image, {.step = 1});
    };
    EXPECT_TRUE(holds_in("Estop", 0x00));
    EXPECT_FALSE(holds_in("Estop", 0x04));
    EXPECT_TRUE(holds_in("IN2 AND NOT estop", 0x04));
    EXPECT_FALSE(holds_in("IN2", 0x00));
    const PropertyReading assumed = read_properties(
        "ASSUME Estop STABLE FOR 50 ms; ASSUME NEVER Estop AND Start; PROPERTY A: NEVER Start;",
        result.symbols);
    EXPECT_TRUE(assumed.diagnostics.empty());
    ASSERT_EQ(assumed.assumptions.size(), 2U);
    EXPECT_EQ(assumed.assumptions[0].input, 2);
    EXPECT_TRUE(holds(assumed.assumptions[1].never, 0x01, {}));
    EXPECT_FALSE(holds(assumed.assumptions[1].never, 0x05, {}));
    const PropertyReading negated =
        read_properties("ASSUME NOT Estop STABLE FOR 50 ms; PROPERTY A: NEVER Start;", result.symbols);
    EXPECT_FALSE(negated.diagnostics.empty());
}

TEST(InvertedInput, ADebuggersConditionsGoByTheName) {
    const std::string source = step_with("Start AT IN0; Estop AT NOT IN2;", "Estop AND IN2 OR Start");
    const Conditions conditions(Sources({"p.seq", source}));
    const auto off = conditions.of("S", {.inputs = 0x00});
    ASSERT_EQ(off.size(), 1U);
    ASSERT_EQ(off[0].parts.size(), 3U);
    EXPECT_EQ(off[0].parts[0].text, "Estop");
    EXPECT_TRUE(off[0].parts[0].holds);
    EXPECT_FALSE(off[0].parts[1].holds);
    EXPECT_FALSE(off[0].holds);
    const auto on = conditions.of("S", {.inputs = 0x04});
    EXPECT_FALSE(on[0].parts[0].holds);
    EXPECT_TRUE(on[0].parts[1].holds);
}

}  // namespace
}  // namespace nplc::seqc
