// Properties are refused in a program for the same reasons as in a file.
#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "seqc/properties.h"
#include "support.h"

namespace nplc::seqc {
namespace {

constexpr auto kClaims = std::to_array<std::string_view>({
    "PROPERTY A: NEVER Heat AND Air;",
    "PROPERTY A: NEVER Heat AND Aire;",
    "PROPERTY A: NEVER IN5 OR OUT3 OR %IX0.5 OR %QX0.3;",
    "PROPERTY A: NEVER IN6;",
    "PROPERTY A: NEVER %QX0.4;",
    "PROPERTY A: NEVER IN05;",
    "PROPERTY A: STEP = Work IS REACHABLE;",
    "PROPERTY A: STEP = Wrok IS REACHABLE;",
    "PROPERTY A: STEP = 62 IS REACHABLE;",
    "PROPERTY A: STEP = 63 IS REACHABLE;",
    "PROPERTY A: STEP = POWER_UP IS REACHABLE;",
    "PROPERTY A: STEP = Idle_Go_off IS REACHABLE;",
    "PROPERTY A: STEP = Idle_Go_odd IS REACHABLE;",
    "PROPERTY A: NEVER STEP IN Both AND Go;",
    "PROPERTY A: NEVER step in both;",
    "PROPERTY A: NEVER STEP IN Idle;",
    "PROPERTY A: NEVER STEP IN Botj;",
    "PROPERTY A: NEVER STEP IN Go;",
    "PROPERTY A: NEVER STEP = Both;",
    "PROPERTY A: BETWEEN STEP IN Both AND (NOT Go) Air STAYS ON;",
    "PROPERTY A: NEVER moving; PROPERTY a: NEVER moving;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 20;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 0 ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 1.5 s;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 1.0005 s;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 60 min;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 61 min;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1s500ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1h;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1h1ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN TIME#1m30s;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1d;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1.5s;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#0.5ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 20 (* a_b *) ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN T#1_000ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 1_000 ms;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN 16#20;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN Short;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN Nothing;",
    "PROPERTY A: WHENEVER Go FOR long THEN Air;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN Many;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN Part;",
    "PROPERTY A: WHENEVER Go FOR None THEN Air;",
    "PROPERTY A: WHENEVER Go THEN Air WITHIN Go;",
    "ASSUME Go STABLE FOR Short;",
    "PROPERTY A: NEVER Heat WHILE Go FOR 0 ms;",
    "PROPERTY A: NEVER Heat WHILE Go FOR 1 ms;",
    "PROPERTY A: WHENEVER Go FOR 0 s THEN Air;",
    "ASSUME NEVER Go AND ERROR;",
    "ASSUME NEVER Go AND Heat;",
    "ASSUME NEVER TIMER.Q;",
    "ASSUME NEVER (NOT INPOS OR TRUE) XOR IN3;",
    "ASSUME Go STABLE FOR 50 ms;",
    "ASSUME Heat STABLE FOR 50 ms;",
    "ASSUME INPOS STABLE FOR 50 ms;",
    "ASSUME moving ENDS WITHIN 2 s;",
    "ASSUME moving ENDS WITHIN 0 ms;",
    "ASSUME Go ENDS WITHIN 2 s;",
});

std::string program_with(std::string_view claim) {
    return "PROGRAM P\n"
           "VAR_INPUT Go AT IN0 : BOOL; END_VAR\n"
           "VAR_OUTPUT Heat AT OUT0 : BOOL; Air AT OUT1 : BOOL; END_VAR\n"
           "CONST Short := T#50ms; CONST Long := 2 * Short + 1 s; CONST Many := 5; CONST Part := 0.5 ms; "
           "CONST "
           "None := 0 ms;\n"
           "GROUP Both: Idle, Work;\n"
           "STEP Idle: OWN ERROR; OUT Heat; IF R_TRIG(Go) THEN NEXT := Work; END_IF END_STEP\n"
           "STEP Work: OWN ERROR; OUT Air; IF NOT Go THEN NEXT := Idle; END_IF END_STEP\n" +
           std::string(claim) + "\nEND_PROGRAM\n";
}

TEST(Claims, AreRefusedInAProgramAsInAFile) {
    const Symbols symbols = compile(program_with("")).symbols;
    for (const std::string_view claim : kClaims) {
        const std::string source = program_with(claim);
        const Compilation program = compile(source);
        EXPECT_EQ(program.ok, read_properties(claim, symbols).diagnostics.empty())
            << claim << "\n"
            << test::shown(program, source);
        if (!program.ok) continue;
        const PropertyReading reading = properties_of(Sources({{}, source}), program.symbols);
        EXPECT_TRUE(reading.diagnostics.empty()) << claim;
        EXPECT_EQ(reading.properties.size() + reading.assumptions.size(), 1U) << claim;
    }
}

// Idle has a copy in which Go is still on: the edge is not armed.
TEST(Claims, AGroupMeansTheCopiesOfItsStepsToo) {
    const std::string source = program_with("PROPERTY A: ALWAYS STEP IN Both OR STEP = POWER_UP;");
    const Compilation program = compile(source);
    ASSERT_TRUE(program.ok) << test::shown(program, source);
    ASSERT_EQ(program.symbols.groups.size(), 1U);
    std::uint64_t steps = 0;
    for (std::size_t i = 1; i < program.symbols.steps.size(); ++i) {
        if (!program.symbols.steps[i].empty()) steps |= std::uint64_t{1} << i;
    }
    EXPECT_EQ(std::popcount(steps), 3) << "Idle, its copy and Work";
    EXPECT_EQ(program.symbols.groups[0].steps, steps);
}

TEST(Claims, AreNotLookedUpWhereStepsCouldNotBeRead) {
    const std::string source = program_with("PROPERTY A: STEP = Third IS REACHABLE; STEP Third OWN ERROR;");
    for (const Diagnostic& d : compile(source).diagnostics)
        EXPECT_EQ(d.message.find("'Third'"), std::string::npos) << d.message;
}

}  // namespace
}  // namespace nplc::seqc
