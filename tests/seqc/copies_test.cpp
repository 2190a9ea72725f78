// Copies of steps: their names, their numbers, the other places that show them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "seqc/properties.h"
#include "seqc/seqc.h"
#include "seqc/symbol_file.h"

namespace nplc::seqc {
namespace {

/// Down is reached with the clamp on and with it off; Idle waits for an edge.
constexpr std::string_view kClamping = R"(PROGRAM P
MOTOR MAC140;
VAR_INPUT Start AT IN0 : BOOL; Ack AT IN1 : BOOL; END_VAR
VAR_OUTPUT Clamp AT OUT0 : BOOL; END_VAR
ON ERROR NEXT := Fault;
STEP Idle: IF R_TRIG(Start) THEN SET Clamp; NEXT := Down; ELSIF Ack THEN NEXT := Down; END_IF END_STEP
STEP Down: IF IN2 THEN RESET Clamp; NEXT := Idle; END_IF END_STEP
STEP Fault: OWN ERROR; ENTRY RESET Clamp; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP
END_PROGRAM
)";

std::size_t number_of(const Symbols& symbols, std::string_view name) {
    for (std::size_t i = 0; i < symbols.steps.size(); ++i) {
        if (symbols.steps[i] == name) return i;
    }
    return symbols.steps.size();
}

TEST(Copies, HaveTheLowestFreeNumbersAndNamesThatSayInWhatTheyDiffer) {
    const Compilation result = compile(kClamping);
    ASSERT_TRUE(result.ok);
    const Symbols& symbols = result.symbols;
    EXPECT_EQ(symbols.steps[1], "Idle");
    EXPECT_EQ(symbols.steps[2], "Down");
    EXPECT_EQ(symbols.steps[3], "Fault");
    const std::size_t armed = number_of(symbols, "Idle_Start_off");
    const std::size_t other = number_of(symbols, "Down_Clamp_on");
    ASSERT_LT(armed, symbols.steps.size());
    ASSERT_LT(other, symbols.steps.size());
    EXPECT_EQ(armed + other, 4U + 5U);
    EXPECT_EQ(symbols.copy_of[armed], 1);
    EXPECT_EQ(symbols.copy_of[other], 2);
    EXPECT_EQ(symbols.made_for[other], "copy of 'Down' for: Clamp on");
    EXPECT_FALSE(symbols.copy_of[1]);
    EXPECT_EQ(with_copies(symbols, 2), std::uint64_t{1} << 2 | std::uint64_t{1} << other);
}

TEST(Copies, ComeBackFromTheFileOfSymbols) {
    const Compilation result = compile(kClamping);
    const auto file = read_symbols(write_symbols(result, kClamping, "p.seq"));
    ASSERT_EQ(file.error, "");
    EXPECT_EQ(file.file.symbols.copy_of, result.symbols.copy_of);
}

TEST(Copies, AreMeantByTheNameOfTheirStepInProperties) {
    const Compilation result = compile(kClamping);
    const PropertyReading read = read_properties(
        "PROPERTY A: NEVER STEP = Down; PROPERTY B: NEVER STEP = Down_Clamp_on;", result.symbols);
    ASSERT_EQ(read.properties.size(), 2U);
    const auto& whole = read.properties[0].condition;
    ASSERT_EQ(whole.kind, verify::Condition::Kind::any_of);
    ASSERT_EQ(whole.operands.size(), 2U);
    EXPECT_EQ(whole.operands[0].number, 2);
    EXPECT_EQ(whole.operands[1].number, number_of(result.symbols, "Down_Clamp_on"));
    EXPECT_EQ(read.properties[1].condition.kind, verify::Condition::Kind::step);
}

TEST(Copies, AreNotMadeWhereNothingAsksForThem) {
    const Compilation result = compile(
        "PROGRAM P\nMOTOR MAC140;\nSTEP S: OWN ERROR; ENTRY SET OUT0; IF IN0 THEN NEXT := T; END_IF "
        "END_STEP\n"
        "STEP T: OWN ERROR; ENTRY RESET OUT0; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n");
    ASSERT_TRUE(result.ok);
    EXPECT_EQ(result.symbols.steps[3], "");
    EXPECT_EQ(result.steps[1].outputs, 1);
    EXPECT_EQ(result.steps[2].outputs, 0);
}

/// Four outputs that are set in any order: 16 copies of Idle, and none too many for the table.
TEST(Copies, AFullTableIsRefusedWithTwoWays) {
    std::string text = "PROGRAM P\nMOTOR MAC140;\n";
    for (int step = 0; step < 5; ++step) {
        text += fmt::format(
            "STEP S{0}: OWN ERROR; IF IN0 THEN SET OUT0; ELSIF IN1 THEN SET OUT1; ELSIF IN2 THEN SET OUT2; "
            "ELSIF IN3 "
            "THEN SET OUT3; ELSIF IN4 THEN RESET OUT0, OUT1, OUT2, OUT3; ELSIF IN5 THEN NEXT := S{1}; END_IF "
            "END_STEP\n",
            step, (step + 1) % 5);
    }
    const Compilation result = compile(text + "END_PROGRAM\n");
    ASSERT_FALSE(result.ok);
    EXPECT_EQ(result.diagnostics.front().code, "E074");
    // 5 steps x 2^4 combinations of the outputs
    EXPECT_TRUE(result.diagnostics.front().help.starts_with(
        "80 numbers are needed and there are 61: 19 are missing; "))
        << result.diagnostics.front().help;
}

}  // namespace
}  // namespace nplc::seqc
