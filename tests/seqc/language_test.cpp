#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

Compilation sound(const std::string& source) {
    Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    EXPECT_EQ(test::codes_in_frame(result), "") << test::shown(result, source);
    return result;
}

TEST(Language, CaseCountsNot) {
    const auto a = sound(test::program("STEP S: IF A AND NOT Inpos THEN NEXT := Other; END_IF END_STEP"));
    const auto b = sound(test::program("step s: if a and not INPOS then next := OTHER; end_if; end_step"));
    EXPECT_EQ(a.table, b.table);
}

TEST(Language, CommentsAndBlanksAreFree) {
    const auto a = sound("PROGRAM P STEP S: OWN ERROR; IF IN0 THEN NEXT := S; END_IF END_STEP END_PROGRAM");
    const auto b = sound(
        "\xEF\xBB\xBF(* a\n comment ** *)PROGRAM P // and another\r\n\tSTEP S : OWN ERROR ;;\r\n"
        "IF IN0(**)THEN NEXT:=S;END_IF END_STEP END_PROGRAM//");
    EXPECT_EQ(a.table, b.table);
}

TEST(Language, InputsByNameByAddressAndByNumber) {
    const auto a = sound(test::program("STEP S: IF A AND B THEN NEXT := Other; END_IF END_STEP"));
    const auto b = sound(test::program("STEP S: IF %IX0.0 AND IN1 THEN NEXT := Other; END_IF END_STEP"));
    EXPECT_EQ(a.table, b.table);
}

TEST(Language, AndBindsTighterThanXorThanOr) {
    const auto a = sound(test::program("STEP S: IF A OR B XOR C AND D THEN NEXT := Other; END_IF END_STEP"));
    const auto b =
        sound(test::program("STEP S: IF A OR (B XOR (C AND D)) THEN NEXT := Other; END_IF END_STEP"));
    EXPECT_EQ(a.table, b.table);
}

// Rule: NOT ERROR unless ERROR is named.
TEST(Language, ConditionsMeanNoErrorUnlessTheyNameIt) {
    const auto t =
        sound(
            "PROGRAM P STEP S: OWN ERROR; IF IN0 THEN NEXT := U; ELSIF ERROR THEN NEXT := V; ELSE NEXT := W; "
            "END_IF END_STEP STEP U: OWN ERROR; END_STEP STEP V: OWN ERROR; END_STEP STEP W: OWN ERROR; "
            "END_STEP END_PROGRAM")
            .table;
    EXPECT_EQ(test::scan(t, 1, 0x01, false, false).next, 2);
    EXPECT_EQ(test::scan(t, 1, 0x81, false, false).next, 3);
    EXPECT_EQ(test::scan(t, 1, 0x80, false, false).next, 3);
    EXPECT_EQ(test::scan(t, 1, 0x00, false, false).next, 4);
}

TEST(Language, AnyErrorSpansBoth) {
    const auto t =
        sound(
            "PROGRAM P STEP S: OWN ERROR; IF ANY ERROR AND IN0 THEN NEXT := U; END_IF END_STEP STEP U: OWN "
            "ERROR; END_STEP END_PROGRAM")
            .table;
    EXPECT_EQ(test::scan(t, 1, 0x01, false, false).next, 2);
    EXPECT_EQ(test::scan(t, 1, 0x81, false, false).next, 2);
    EXPECT_EQ(test::scan(t, 1, 0x80, false, false).next, std::nullopt);
}

TEST(Language, EntryComesAfterTheBranchsOwnCommands) {
    const auto t =
        sound(test::program("STEP S: IF B THEN RESET_ERROR; NEXT := T; END_IF END_STEP\n"
                            "STEP T: OUT Y; ENTRY CLEAR_P_IST; ENTRY INPOSWIN := 9; ENTRY TIMER := T#2s;\n"
                            "IF TIMER.Q THEN NEXT := Other; END_IF END_STEP"))
            .table;
    const test::Scan s = test::scan(t, 1, 0x02, false, false);
    EXPECT_EQ(s.sends, (std::vector<std::string>{"61", "63", "33=9"}));
    EXPECT_EQ(s.timer, 2000);
    EXPECT_EQ(s.outputs, 4);
}

TEST(Language, EntryOfTheFirstStepHappensAtPowerUp) {
    const auto t =
        sound(
            "PROGRAM P STEP S: OWN ERROR; OUT OUT0; ALLOW W044 BECAUSE 'it homes then'; ENTRY HOME; "
            "END_STEP END_PROGRAM")
            .table;
    EXPECT_EQ(test::scan(t, 0, 0, true, true), (test::Scan{.next = 1, .outputs = 1, .sends = {"70"}}));
    EXPECT_EQ(test::scan(t, 0, 0x80, true, true), test::Scan{}) << "it waits for the error to go";
}

TEST(Language, NextPowerUpStartsAgain) {
    const auto t =
        sound(
            test::program("STEP S: IF A THEN NEXT := Other; ELSIF B THEN NEXT := POWER_UP; END_IF END_STEP"))
            .table;
    EXPECT_EQ(test::scan(t, 1, 0x02, false, false).next, 0);
}

TEST(Language, ValuesOfPowerUpGoOutWithAnErrorToo) {
    const auto t =
        sound(
            "PROGRAM P MOTOR MAC140; VAR_MOTOR v AT V1 := 100; END_VAR ON ERROR NEXT := Fault;\n"
            "POWER_UP INIT(v); NEXT := S; END_POWER_UP STEP S: END_STEP\n"
            "STEP Fault: OWN ERROR; IF ANY ERROR AND IN0 THEN RESET_ERROR; NEXT := S; END_IF END_STEP "
            "END_PROGRAM")
            .table;
    EXPECT_EQ(test::scan(t, 0, 0x00, true, true).sends, (std::vector<std::string>{"65=100", "08"}));
    EXPECT_EQ(test::scan(t, 0, 0x80, true, true).sends, (std::vector<std::string>{"65=100"}));
    EXPECT_EQ(test::scan(t, 0, 0x80, true, true).next, 2);
}

TEST(Language, StatementsWithoutIfHappenAtOnce) {
    const auto t = sound(test::program("STEP S: RESET_ERROR; NEXT := Other; END_STEP")).table;
    EXPECT_EQ(test::scan(t, 1, 0, false, false), (test::Scan{.next = 2, .outputs = 2, .sends = {"61"}}));
}

TEST(Language, TimesInEveryForm) {
    for (const char* time :
         {"T#1s500ms", "t#1500ms", "TIME#1.5s", "T#0m1s500ms", "1500 ms", "1.5 s", "T#1_500ms"}) {
        const auto t = sound(test::program("STEP S: IF A THEN TIMER := " + std::string(time) +
                                           "; NEXT := Other; END_IF END_STEP"))
                           .table;
        EXPECT_EQ(test::scan(t, 1, 1, false, false).timer, 1500) << time;
    }
}

TEST(Language, NumbersAsInTheGrammar) {
    const auto written = [](const std::string& value) {
        return compile(
            test::program("STEP S: IF A THEN INPOSWIN := " + value + "; NEXT := Other; END_IF END_STEP"));
    };
    for (const char* number : {"10", "1_0", "1__0", "10_", "1_0_ counts", "16#0A", "10.0"}) {
        const Compilation result = written(number);
        ASSERT_TRUE(result.ok) << number << test::codes(result);
        EXPECT_EQ(test::scan(result.table, 1, 1, false, false).sends, (std::vector<std::string>{"33=10"}))
            << number;
    }
    for (const char* number : {"10.0_0", "10.0_", "16#", "3#1", "16#G"})
        EXPECT_EQ(test::codes(written(number)), "E003") << number;
    EXPECT_EQ(test::codes(written("_10")), "E021");
    EXPECT_EQ(test::codes(written("10.")), "E010");
    for (const char* time : {"T#1s_500ms", "T#_1s", "T#1_m_s", "T#1.5_0s", "T#1.s", "T#s", "T#"}) {
        const std::string source = test::program("STEP S: IF A THEN TIMER := " + std::string(time) +
                                                 "; NEXT := Other; END_IF END_STEP");
        EXPECT_EQ(test::codes(compile(source)).substr(0, 4), "E004") << time;
    }
}

TEST(Language, BlanksAndCommentsInAUnit) {
    for (const char* unit : {"rev/s", "rev / s", "rev (* a *) / (* b *) s", "REV// in a second\n / s"}) {
        const std::string source = test::program("STEP S: IF A THEN V_SOLL := 1 " + std::string(unit) +
                                                 "; NEXT := Other; END_IF END_STEP");
        const Compilation result = compile(source);
        ASSERT_TRUE(result.ok) << test::shown(result, source);
        // 4096 counts/s / 520.83 x 16 = 125.83
        EXPECT_EQ(test::scan(result.table, 1, 1, false, false).sends, (std::vector<std::string>{"5=126"}))
            << unit;
    }
}

TEST(Language, ConditionsAHundredDeep) {
    const auto nested = [](int depth, const std::string& open, const std::string& close) {
        std::string text = "IN0";
        for (int i = 0; i < depth; ++i) text = open + text + close;
        return test::codes_in_frame(
            compile(test::program("STEP S: IF " + text + " THEN NEXT := Other; END_IF END_STEP")));
    };
    EXPECT_EQ(nested(100, "(", ")"), "");
    EXPECT_EQ(nested(100, "NOT ", ""), "");
    EXPECT_EQ(nested(50, "NOT (", ")"), "");
    EXPECT_EQ(nested(101, "(", ")"), "E013");
    EXPECT_EQ(nested(101, "NOT ", ""), "E013");
}

TEST(Language, AWordOfTheLanguageIsNoNameInATerm) {
    const std::string term = "TERM POWER_UP: IF IN0 THEN NEXT := S; END_IF;";
    EXPECT_EQ(test::codes(compile("PROGRAM P STEP S: OWN ERROR; END_STEP " + term + " END_PROGRAM")), "E011");
    EXPECT_EQ(test::codes(compile("PROGRAM P STEP S: OWN ERROR; " + term + " END_STEP END_PROGRAM")), "E011");
}

TEST(Language, RegistersByNameVariableAndNumber) {
    for (const char* target : {"INPOSWIN", "REG(33)", "Window"}) {
        const auto t = sound(
                           "PROGRAM P MOTOR MAC140; VAR_MOTOR Window AT INPOSWIN; END_VAR STEP S: OWN ERROR; "
                           "IF IN0 THEN " +
                           std::string(target) +
                           " := 20; NEXT := U; END_IF END_STEP STEP U: OWN ERROR; END_STEP "
                           "END_PROGRAM")
                           .table;
        EXPECT_EQ(test::scan(t, 1, 1, false, false).sends, (std::vector<std::string>{"33=20"})) << target;
    }
}

TEST(Language, SymbolsForOtherTools) {
    const auto result = sound(test::program("STEP S: IF A THEN NEXT := Other; END_IF END_STEP"));
    EXPECT_EQ(result.symbols.program, "Test");
    EXPECT_EQ(result.symbols.motor, registers::Model::mac140);
    EXPECT_EQ(result.symbols.steps[0], "POWER_UP");
    EXPECT_EQ(result.symbols.steps[1], "S");
    EXPECT_EQ(result.symbols.steps[3], "Fault");
    EXPECT_EQ(result.symbols.steps[4], "");
    EXPECT_EQ(result.symbols.inputs[5], "F");
    EXPECT_EQ(result.symbols.outputs[0], "W");
    EXPECT_EQ(result.origins.size() * 8, result.table.size());
}

TEST(Language, SixtyOneSteps) {
    std::string steps;
    for (int i = 1; i <= 61; ++i) {
        steps += "STEP N" + std::to_string(i) + ": OWN ERROR; NEXT := N" + std::to_string(i % 61 + 1) +
                 "; END_STEP\n";
    }
    const auto result = sound("PROGRAM P\n" + steps + "END_PROGRAM");
    EXPECT_EQ(test::scan(result.table, 60, 0, false, false).next, 61);
    EXPECT_EQ(test::scan(result.table, 61, 0, false, false).next, 1);
}

TEST(Language, NothingIsWrittenWhenThereAreErrors) {
    const Compilation result = compile("PROGRAM P STEP S: OWN ERROR; NEXT := Nowhere; END_STEP END_PROGRAM");
    EXPECT_FALSE(result.ok);
    EXPECT_TRUE(result.table.empty());
}

}  // namespace
}  // namespace nplc::seqc
