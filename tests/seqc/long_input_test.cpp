// Long programs are answered as short ones are; how soon: long_input_time_test.cpp.
#include <gtest/gtest.h>

#include "long_programs.h"
#include "seqc/format.h"
#include "seqc/symbol_file.h"
#include "support.h"

namespace nplc::seqc {
namespace {

using test::at_top;
using test::in_step;
using test::text_of;

constexpr int kMany = 2'000;
constexpr test::Many many{kMany};

TEST(LongInput, IsAnsweredAsAShortOneIs) {
    for (const test::Long& example : test::long_programs(kMany)) {
        SCOPED_TRACE(example.what);
        const Compilation result = compile(example.source);
        render_all(result, example.source, "long.seq");
        if (result.ok) {
            listing(result, example.source, "long.seq");
            write_symbols(result, example.source, "long.seq");
        }
        const Formatted formatted = format_program(example.source);
        EXPECT_EQ(formatted.fault, "");
        EXPECT_LE(result.diagnostics.size(), 100U);
        EXPECT_TRUE(example.codes.empty() || test::codes(result).starts_with(example.codes))
            << test::codes(result).substr(0, 100);
    }
}

TEST(LongInput, MoreThanFourMillionWordsAreNoProgram) {
    const std::string source = in_step(std::string(10'000'000, ';'));
    EXPECT_EQ(test::codes(compile(source)), "E001");
    const Formatted formatted = format_program(source);
    ASSERT_EQ(formatted.diagnostics.size(), 1U);
    EXPECT_EQ(formatted.diagnostics.front().message, "more than 4000000 words and signs: this is no program");
}

TEST(LongInput, OneMessageWhereALimitIsCertain) {
    const std::string steps =
        at_top(many([](int i) { return "STEP T" + text_of(i) + ": OWN ERROR; END_STEP\n"; }));
    EXPECT_EQ(test::codes(compile(steps)), "E083");
    EXPECT_EQ(test::codes(compile(in_step("IF IN0 THEN " + many("EVERY_SCAN STOP; ") + "END_IF"))), "E086");
    std::string values;
    for (int i = 0; i < 61; ++i) {
        values += "STEP T" + text_of(i) + ": OWN ERROR; IF IN1 THEN NEXT := T" + text_of((i + 1) % 61) +
                  "; ELSIF IN0 THEN ";
        for (int k = 0; k < 100; ++k) values += "EVERY_SCAN V_SOLL := " + text_of(k) + "; ";
        values += "END_IF END_STEP\n";
    }
    const std::string program = "PROGRAM P MOTOR MAC140;\n" + values + "END_PROGRAM";
    const Compilation result = compile(program);
    // 61 steps of 100 values, POWER_UP's term and the end.
    EXPECT_EQ(test::codes(result), "E086");
    EXPECT_NE(test::shown(result, program).find("at least 6102 terms"), std::string::npos);
}

// An error takes the place of a warning, so that it is not lost behind a hundred of them.
TEST(LongInput, WarningsDoNotHideThatTwoIfsHoldTogether) {
    std::string never;
    for (int i = 0; i < 200; ++i) never += "IF IN0 AND NOT IN0 THEN NEXT := S; END_IF\n";
    const std::string source =
        in_step(never + "IF IN0 THEN EVERY_SCAN STOP; END_IF IF IN1 THEN EVERY_SCAN NOP; END_IF");
    const Compilation result = compile(source);
    EXPECT_FALSE(result.ok);
    EXPECT_NE(test::codes(result).find("E070"), std::string::npos) << test::codes(result);
}

}  // namespace
}  // namespace nplc::seqc
