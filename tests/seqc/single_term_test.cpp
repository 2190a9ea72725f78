// A term in symbols and the numbers of steps, against bytes put together by hand from 001 §6.1.5 - §6.1.8.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

std::string in_program(const std::string& inside, const std::string& outside = {}) {
    return "PROGRAM P MOTOR MAC140; VAR_INPUT Start AT IN0 : BOOL; END_VAR VAR_OUTPUT Grip AT OUT1 : BOOL; "
           "END_VAR\n"
           "STEP S: OWN ERROR; " +
           inside + "\nNEXT := T; END_STEP\nSTEP T: OWN ERROR; NEXT := S; END_STEP\n" + outside +
           "\nEND_PROGRAM\n";
}

/// The bytes of the term inside step S, which is number 1: the third of the table.
std::string inside(const std::string& term) {
    const std::string source = in_program(term);
    const Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    return test::term_text(result.table, 2);
}

/// Codes of what is wrong with it.
std::string wrong(const std::string& term) {
    const std::string source = in_program(term);
    const Compilation result = compile(source);
    EXPECT_FALSE(result.ok) << source;
    return test::codes(result);
}

TEST(SingleTerm, ConditionIsAProduct) {
    // STATE C1h: step 1, neither zero needed. INPUT and CARE bit 0 Start, bit 3, bit 6 INPOS, bit 7 ERROR.
    EXPECT_EQ(inside("TERM IF Start AND NOT IN3 AND INPOS THEN NEXT := T; END_IF;"),
              "C1 41 49 02 80 00 00 00");
    EXPECT_EQ(inside("TERM IF ERROR AND NOT INPOS THEN NEXT := T; END_IF;"), "C1 80 40 02 80 00 00 00");
    EXPECT_EQ(inside("TERM IF NOT ERROR AND (IN5 AND Start) THEN NEXT := T; END_IF;"),
              "C1 21 21 02 80 00 00 00");
    EXPECT_EQ(inside("TERM IF TRUE THEN NEXT := T; END_IF;"), "C1 00 00 02 80 00 00 00");
    // TIMER_BIT (80h) or COUNTER_BIT (40h) clear: must be zero.
    EXPECT_EQ(inside("TERM IF TIMER.Q THEN NEXT := T; END_IF;"), "41 00 00 02 80 00 00 00");
    EXPECT_EQ(inside("TERM IF COUNTER.Q AND TIMER.Q THEN NEXT := T; END_IF;"), "01 00 00 02 80 00 00 00");
}

TEST(SingleTerm, Statements) {
    // No NEXT: 3Eh. No command: FAST_DIS 80h. Outputs, CLR_CNT 40h, CNT_DWN 80h; CNT_TIME 40h.
    EXPECT_EQ(inside("TERM IF TRUE THEN OUT Grip, OUT3; END_IF;"), "C1 00 00 3E 80 0A 00 00");
    EXPECT_EQ(inside("TERM IF TRUE THEN END_IF;"), "C1 00 00 3E 80 00 00 00");
    EXPECT_EQ(inside("TERM IF TRUE THEN POSITION(P2); TIMER := T#500ms; NEXT := T; END_IF"),
              "C1 00 00 02 41 00 F4 01");
    EXPECT_EQ(
        inside("TERM IF TRUE THEN COUNTER := 258; COUNT_DOWN; CLEAR_COUNTER; NEXT := POWER_UP; END_IF;"),
        "C1 00 00 40 80 C0 02 01");
    EXPECT_EQ(inside("TERM IF TRUE THEN COUNTER := 0; END_IF;"), "C1 00 00 3E 80 40 00 00");
    EXPECT_EQ(inside("TERM IF TRUE THEN NOP; END_IF;"), "C1 00 00 3E 60 00 00 00");
    // CMD_FORMAT 80h in CARE; register 65 = 41h, 16 bits; register 51 = 33h with LONGWORD 80h.
    EXPECT_EQ(inside("TERM IF Start THEN V1 := -2; END_IF;"), "C1 01 81 41 FE FF 00 00");
    EXPECT_EQ(inside("TERM IF TRUE THEN REG(51) := 65538; END_IF;"), "C1 00 80 B3 02 00 01 00");
}

TEST(SingleTerm, OutsideOfStepsItFollowsAllOthers) {
    const Compilation result = compile(in_program("TERM IF TRUE THEN OUT OUT0; END_IF;",
                                                  "TERM T: IF IN0 THEN NEXT := S; END_IF;\n"
                                                  "TERM 16#C1, 0, 0, 16#3E, 16#80, 4, 0, 0;\n"
                                                  "TERM S: IF IN1 THEN OUT OUT3; END_IF;\n"));
    ASSERT_TRUE(result.ok);
    // 0 power-up, 1 and 2 of S, 3 of T
    EXPECT_EQ(test::term_text(result.table, 4), "C2 01 01 01 80 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 5), "C1 00 00 3E 80 04 00 00");
    EXPECT_EQ(test::term_text(result.table, 6), "C1 02 02 3E 80 08 00 00");
    EXPECT_EQ(test::term_text(result.table, 7), "3F 00 00 00 00 00 00 00");
}

TEST(SingleTerm, TermsMayHoldTogether) {
    const std::string source = in_program(
        "TERM IF IN0 THEN STOP; NEXT := T; END_IF; TERM IF IN1 THEN POSITION(P1); NEXT := S; END_IF; "
        "TERM IF IN0 THEN VELOCITY(A1); END_IF;");
    EXPECT_TRUE(compile(source).ok);
}

TEST(SingleTerm, WhatOneTermCannotHoldIsAnError) {
    EXPECT_EQ(wrong("TERM IF IN0 OR IN1 THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF IN0 XOR IN1 THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF NOT TIMER.Q THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF IN0 AND NOT COUNTER.Q THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF NOT (IN0 AND IN1) THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF ANY ERROR THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF FALSE THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF IN0 AND NOT IN0 THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF ERROR AND NOT ERROR THEN NEXT := T; END_IF;"), "E093");
    EXPECT_EQ(wrong("TERM IF IN0 THEN STOP; HOME; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN INIT(V1, A1); END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN TIMER := T#1s; COUNTER := 2; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN V1 := 5; NEXT := T; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN COUNT_DOWN; V1 := 5; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN V1 := 5; OUT Grip; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN NEXT := T; ELSE NEXT := S; END_IF;"), "E094");
    EXPECT_EQ(wrong("TERM IF IN0 THEN NEXT := T; NEXT := S; END_IF;"), "E061");
    EXPECT_EQ(wrong("TERM IF IN0 THEN TIMER := T#1s; TIMER := T#2s; END_IF;"), "E061");
    EXPECT_EQ(wrong("TERM IF IN0 THEN EVERY_SCAN STOP; END_IF;"), "E064");
    EXPECT_EQ(wrong("TERM IF IN0 THEN NEXT := Q; END_IF;"), "E021");
    EXPECT_EQ(wrong("TERM IF IN0 THEN OUT IN0; END_IF;"), "E023");
    EXPECT_EQ(wrong("TERM IF IN0 THEN SAFE_COMMUNICATION; END_IF;"), "E051");
    EXPECT_EQ(wrong("TERM IF IN0 THEN V1 := 40000; END_IF;"), "E042");
    EXPECT_EQ(wrong("TERM T: IF IN0 THEN NEXT := T; END_IF;"), "E092");
    EXPECT_EQ(wrong("TERM IF IN0 NEXT := T; END_IF;"), "E010");
    EXPECT_EQ(wrong("TERM IF IN0 THEN NEXT := T;"), "E012");
    EXPECT_EQ(test::codes(compile(in_program("", "TERM IF IN0 THEN NEXT := T; END_IF;"))), "E094");
    EXPECT_EQ(test::codes(compile(in_program("", "TERM Q: IF IN0 THEN NEXT := T; END_IF;"))), "E021");
    EXPECT_EQ(test::codes(compile(in_program("TERM S: IF IN0 THEN NEXT := T; END_IF;"))), "");
}

TEST(SingleTerm, ItsNextCountsAsAWayToAStep) {
    const std::string lost = "STEP U: OWN ERROR; NEXT := S; END_STEP";
    EXPECT_EQ(test::codes_in_frame(compile(in_program("", lost))), "W005");
    EXPECT_EQ(test::codes(compile(in_program("TERM IF IN0 THEN NEXT := U; END_IF;", lost))), "");
    EXPECT_EQ(test::codes(compile(in_program("TERM 16#C1, 0, 0, 3, 16#80, 0, 0, 0;", lost))), "");
    EXPECT_EQ(test::codes(compile(in_program("", lost + " TERM T: IF IN0 THEN NEXT := U; END_IF;"))), "");
    EXPECT_EQ(test::codes(compile(in_program("", lost + " TERM U: IF IN0 THEN NEXT := U; END_IF;"))), "W005");
}

std::string numbered(const std::string& a, const std::string& b, const std::string& c) {
    return "PROGRAM P STEP A" + a + ": OWN ERROR; NEXT := B; END_STEP STEP B" + b +
           ": OWN ERROR; NEXT := C; END_STEP STEP C" + c + ": OWN ERROR; NEXT := A; END_STEP END_PROGRAM";
}

TEST(StepNumbers, AtGivesThemTheOthersTakeTheLowestFreeOnes) {
    // POWER_UP goes to the step declared first: C0 00 00 05. Then A = 5, B = 2, C = 1, in this order.
    const Compilation result = compile(numbered(" AT 5", " AT 2", ""));
    ASSERT_TRUE(result.ok) << test::shown(result, numbered(" AT 5", " AT 2", ""));
    EXPECT_EQ(test::term_text(result.table, 0), "C0 00 00 05 80 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 1), "C5 00 00 02 80 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 2), "C2 00 00 01 80 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 3), "C1 00 00 05 80 00 00 00");
    EXPECT_EQ(result.symbols.steps[5], "A");
    EXPECT_EQ(result.symbols.steps[0], "POWER_UP");
    const Compilation based = compile(numbered("", " AT 2#1", " AT 61"));
    ASSERT_TRUE(based.ok);
    EXPECT_EQ(test::term_text(based.table, 1), "C2 00 00 01 80 00 00 00");
}

TEST(StepNumbers, StepZeroIsWhatPowerUpStartsIn) {
    const Compilation result = compile(numbered("", " AT 0", ""));
    ASSERT_TRUE(result.ok);
    EXPECT_EQ(result.symbols.steps[0], "B");
    EXPECT_EQ(result.table.size(), 4U * 8);  // no hidden step
    EXPECT_EQ(test::term_text(result.table, 0), "C1 00 00 00 80 00 00 00");
    EXPECT_EQ(test::term_text(result.table, 1), "C0 00 00 02 80 00 00 00");
}

TEST(StepNumbers, StepZeroWritesItsOwnOutputs) {
    const std::string source =
        "PROGRAM P STEP A AT 0: OWN ERROR; OUT OUT2; IF IN0 THEN NEXT := B; END_IF END_STEP "
        "STEP B: OWN ERROR; NEXT := A; END_STEP END_PROGRAM";
    const Compilation result = compile(source);
    ASSERT_TRUE(result.ok) << test::shown(result, source);
    for (unsigned c = 0; c < 1024; ++c) {
        const bool leaves = (c & 0x81U) == 1;
        const test::Scan scan = test::scan_case(result.table, 0, c);
        EXPECT_EQ(scan.outputs, leaves ? 0 : 4) << c;
        EXPECT_EQ(scan.next.value_or(0), leaves ? 1 : 0) << c;
    }
    EXPECT_EQ(test::scan(result.table, 1, 0, true, true).outputs, 4);
}

TEST(StepNumbers, SixtyTwoStepsWithAStepZero) {
    std::string source = "PROGRAM P\n";
    for (int i = 0; i < 62; ++i) {
        source += "STEP N" + std::to_string(i) + (i == 40 ? " AT 0" : "") + ": OWN ERROR; NEXT := N" +
                  std::to_string((i + 1) % 62) + "; END_STEP\n";
    }
    EXPECT_EQ(test::codes_in_frame(compile(source + "END_PROGRAM")), "");
    source += "STEP More: OWN ERROR; NEXT := N0; END_STEP END_PROGRAM";
    EXPECT_EQ(test::codes(compile(source)), "E083");
}

TEST(StepNumbers, WhatIsWrongWithThem) {
    EXPECT_EQ(test::codes(compile(numbered(" AT 5", " AT 5", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT 62", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT 63", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT -1", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT 1.5", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT 5 ms", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT T#5ms", "", ""))), "E095");
    EXPECT_EQ(test::codes(compile(numbered(" AT", "", ""))), "E010");
    const std::string twice = numbered(" AT 5", " AT 5", "");
    EXPECT_NE(test::shown(compile(twice), twice).find("it is given here"), std::string::npos);
}

TEST(StepNumbers, NothingOfPowerUpGoesWithAStepZero) {
    const auto with = [](const std::string& head, const std::string& body) {
        const std::string source = "PROGRAM P MOTOR MAC140; " + head +
                                   " STEP A AT 0: OWN ERROR; NEXT := B; " + "END_STEP STEP B: OWN ERROR; " +
                                   body + " END_STEP END_PROGRAM";
        return test::codes_in_frame(compile(source));
    };
    EXPECT_EQ(with("", "NEXT := A;"), "");
    EXPECT_EQ(with("", "NEXT := POWER_UP;"), "E096");
    EXPECT_EQ(with("", "TERM IF TRUE THEN NEXT := POWER_UP; END_IF;"), "E096");
    EXPECT_EQ(with("POWER_UP NEXT := B; END_POWER_UP", ""), "E096");
    EXPECT_EQ(with("VAR_MOTOR v AT V1 := 5; END_VAR", ""), "E096");
    EXPECT_EQ(with("VAR_MOTOR v AT V1; END_VAR", ""), "");
}

}  // namespace
}  // namespace nplc::seqc
