// How many terms a careful engineer needs, counted by hand.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

/// Terms of step S, ON ERROR's one left out.
int terms_for(const std::string& body) {
    const std::string source = test::program("STEP S: OUT W; " + body + " END_STEP");
    const Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    return test::terms_of(result.table, 1) - 1;
}

int terms_for_switch(const std::string& condition) {
    return terms_for("IF " + condition + " THEN NEXT := Other; END_IF");
}

int terms_for_command(const std::string& condition) {
    return terms_for("IF " + condition + " THEN STOP; NEXT := Other; END_IF");
}

TEST(Lowering, SwitchesMayOverlap) {
    EXPECT_EQ(terms_for_switch("A AND NOT B AND INPOS"), 1);
    EXPECT_EQ(terms_for_switch("A OR B"), 2);
    EXPECT_EQ(terms_for_switch("A OR B OR C OR D OR E OR F"), 2);
    EXPECT_EQ(terms_for_switch("A XOR B"), 2);
    EXPECT_EQ(terms_for_switch("A AND B OR A AND NOT B"), 1);             // A
    EXPECT_EQ(terms_for_switch("A AND B OR NOT A AND C OR B AND C"), 2);  // consensus: BC is not needed
    EXPECT_EQ(terms_for_switch("NOT (A AND B AND C)"), 2);
    EXPECT_EQ(terms_for_switch("(A OR B) AND (A OR C)"), 2);  // A + BC
    EXPECT_EQ(terms_for_switch("TRUE"), 1);
    EXPECT_EQ(terms_for_switch("TIMER.Q AND A OR COUNTER.Q"), 2);
    EXPECT_EQ(terms_for_switch("A OR A AND TIMER.Q"), 1);
}

TEST(Lowering, CommandsNeverGoOutTwice) {
    EXPECT_EQ(terms_for_command("A OR B"), 2);  // A, NOT A AND B
    EXPECT_EQ(terms_for_command("A OR B OR C"), 3);
    EXPECT_EQ(terms_for_command("NOT (A AND B AND C)"), 3);
    EXPECT_EQ(terms_for_command("A OR TIMER.Q"), 2);  // A, NOT A AND TIMER.Q
    const std::string source =
        test::program("STEP S: IF A OR B OR C OR D THEN POSITIONS_ABSOLUTE; NEXT := Other; END_IF END_STEP");
    const Compilation result = compile(source);
    for (unsigned inputs = 1; inputs < 16; ++inputs) {
        EXPECT_EQ(test::scan(result.table, 1, inputs, true, true).sends, (std::vector<std::string>{"74"}))
            << inputs;
    }
}

TEST(Lowering, EveryTermOfABranchCarriesOutputsAndNextStep) {
    const std::string source = test::program(
        "STEP S: OUT W; IF A THEN RESET_ERROR; INPOSWIN := 20; COUNT_DOWN; CLEAR_P_IST; NEXT := Other; "
        "END_IF END_STEP");
    const Compilation result = compile(source);
    ASSERT_TRUE(result.ok) << test::shown(result, source);
    EXPECT_EQ(test::term_text(result.table, 2), "C1 80 00 03 80 00 00 00");  // ON ERROR, to Fault
    EXPECT_EQ(test::term_text(result.table, 3),
              "C1 01 01 02 61 82 00 00");  // Other's X is bit 1; CNT_DWN in both
    EXPECT_EQ(test::term_text(result.table, 4), "C1 01 81 21 14 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 5), "C1 01 01 02 63 82 00 00");
}

TEST(Lowering, PresetsRideOnCommands) {
    EXPECT_EQ(terms_for("IF A THEN TIMER := T#1s; NEXT := Other; END_IF"), 1);
    EXPECT_EQ(terms_for("IF A THEN TIMER := T#1s; COUNTER := 3; NEXT := Other; END_IF"), 2);
    EXPECT_EQ(terms_for("IF A THEN STOP; CLEAR_P_IST; TIMER := T#1s; COUNTER := 3; NEXT := Other; END_IF"),
              2);
    EXPECT_EQ(terms_for("IF A THEN INPOSWIN := 9; TIMER := T#1s; NEXT := Other; END_IF"), 2);
}

TEST(Lowering, RegisterWritesAloneNeedNoOtherTerm) {
    EXPECT_EQ(terms_for("IF A THEN EVERY_SCAN INPOSWIN := 9; END_IF"), 1);
}

TEST(Lowering, OverrideForATimerThatStillRuns) {
    // A and the timer runs: A alone, then "timer at zero" goes to the own step.
    EXPECT_EQ(terms_for_switch("A AND NOT TIMER.Q"), 2);
    EXPECT_EQ(terms_for("IF TIMER.Q THEN NEXT := Fault; ELSIF A THEN NEXT := Other; END_IF"), 2);
}

TEST(Lowering, ConditionalOutputsInFewTerms) {
    // The step's own outputs, then with X; ERROR is a case of its own, and there ON ERROR writes.
    EXPECT_EQ(terms_for("OUT X WHEN A;"), 2);
    EXPECT_EQ(terms_for("OUT X WHEN A; OUT Y WHEN B;"), 4);
    EXPECT_EQ(terms_for("OUT X WHEN NOT TIMER.Q;"), 2);
}

TEST(Lowering, OverrideWhereItSavesTerms) {
    // D first, then A AND B AND C over it: 2. Made exclusive, D would need NOT A, NOT B and NOT C: 4.
    EXPECT_EQ(terms_for("IF A AND B AND C THEN NEXT := Fault; ELSIF D THEN NEXT := Other; END_IF"), 2);
    EXPECT_EQ(terms_for("IF A AND B AND C THEN STOP; NEXT := Fault; ELSIF D THEN NEXT := Other; END_IF"), 2);
    // A command cannot be overridden: D AND NOT (A AND B AND C) stays.
    EXPECT_EQ(terms_for("IF A AND B AND C THEN NEXT := Fault; ELSIF D THEN STOP; NEXT := Other; END_IF"), 4);
    // Nothing to save: exclusive products stay exclusive.
    const std::string source =
        test::program("STEP S: IF A THEN NEXT := Fault; ELSIF B THEN NEXT := Other; END_IF END_STEP");
    EXPECT_EQ(test::term_text(compile(source).table, 3), "C1 02 03 02 80 02 00 00");
}

TEST(Lowering, SameEffectInSeveralBranchesIsOneCondition) {
    EXPECT_EQ(terms_for("IF A THEN NEXT := Other; ELSIF B THEN NEXT := Other; END_IF"), 2);
    EXPECT_EQ(terms_for("IF A THEN STOP; NEXT := Other; END_IF IF NOT A THEN STOP; NEXT := Other; END_IF"),
              1);
}

}  // namespace
}  // namespace nplc::seqc
