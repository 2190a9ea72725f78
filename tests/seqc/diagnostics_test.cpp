#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

std::string steps(const std::string& body) {
    return test::program("STEP S: OUT W; " + body + "\nEND_STEP");
}
std::string in_branch(const std::string& statements) {
    return steps("IF A THEN " + statements + " NEXT := Other; END_IF");
}
TEST(Diagnostics, AsTheUserSeesThem) {
    const std::string source =
        "PROGRAM P\nSTEP Travel:\n\tOWN ERROR;\n\tIF IN0 THEN NEXT := Travl; END_IF\nEND_STEP\nEND_PROGRAM\n";
    EXPECT_EQ(test::shown(compile(source), source),
              "test.seq:4:22: error E021: there is no step 'Travl'\n"
              " 4 | \tIF IN0 THEN NEXT := Travl; END_IF\n"
              "   | \t                    ^~~~~\n"
              "  help: did you mean 'Travel'?\n");
}

TEST(Diagnostics, WhatIsMissingBecauseOfAnotherMistakeIsNotReported) {
    const auto codes = [](const std::string& source) { return test::codes(compile(source)); };
    EXPECT_EQ(codes("PROGRAM P STEP S: OWN ERROR; NEXT := T; END_STEP (* STEP T: END_STEP END_PROGRAM"),
              "E002");
    EXPECT_EQ(codes("PROGRAM P STEP S: OWN ERROR; NEXT := (* T; END_STEP STEP T: END_STEP END_PROGRAM"),
              "E002");
    EXPECT_EQ(codes("PROGRAM P STEP S: OWN ERROR; IF IN0 (* THEN NEXT := S; END_IF END_STEP END_PROGRAM"),
              "E002");
    EXPECT_EQ(codes("(* PROGRAM P END_PROGRAM"), "E002");
    EXPECT_EQ(
        codes("PROGRAM P STEP S: OWN ERROR; NEXT := V1; END_STEP STEP 9: OWN ERROR; END_STEP END_PROGRAM"),
        "E010");
    EXPECT_EQ(
        codes("PROGRAM P STEP S: OWN ERROR; NEXT := T; END_STEP STPE T: OWN ERROR; END_STEP END_PROGRAM"),
        "E010");
}

TEST(Diagnostics, RegistersAreCalledAsWritten) {
    const std::string source =
        "PROGRAM P MOTOR MAC800; VAR_MOTOR Soft AT A1 := 1 mm; END_VAR STEP S: OWN ERROR; END_STEP "
        "END_PROGRAM";
    const Compilation result = compile(source);
    ASSERT_EQ(test::codes(result), "E043") << test::shown(result, source);
    EXPECT_EQ(result.diagnostics[0].message, "A1 cannot be given in 'mm'");
}

// Where the motor runs already MODE_REG starts nothing, and 0 stops it.
TEST(Diagnostics, ModeWrittenWhereTheMotorRuns) {
    EXPECT_EQ(test::codes_in_frame(compile(in_branch("MODE_REG := 0;"))), "");
    EXPECT_EQ(test::codes_in_frame(compile(in_branch("VELOCITY(V1); MODE_REG := 2;"))), "");
    EXPECT_EQ(test::codes_in_frame(compile(in_branch("INIT(V1); MODE_REG := 1;"))), "W011");
}

// GP_MODE and its like have no command of their own (001 §4.4): with a velocity selected they are in order.
TEST(Diagnostics, ModesThatFollowTakeTheirLimitFromTheProgram) {
    const auto of = [](const std::string& power_up, const std::string& branch) {
        return test::codes(compile(
            "PROGRAM P MOTOR MAC140; ON ERROR NEXT := Fault; POWER_UP " + power_up +
            " NEXT := S; END_POWER_UP STEP S: IF R_TRIG(IN0) THEN " + branch +
            " NEXT := Other; END_IF END_STEP STEP Other: IF R_TRIG(IN1) THEN NEXT := POWER_UP; END_IF "
            "END_STEP "
            "STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(IN2) THEN RESET_ERROR; NEXT := POWER_UP; END_IF "
            "END_STEP END_PROGRAM"));
    };
    for (const char* mode : {"GP_MODE", "AV_MODE", "AVG_MODE", "AVZ_MODE", "VAT_MODE", "AG_MODE", "COIL_MODE",
                             "A2POS_MODE", "APOS_MODE", "GF_MODE"}) {
        const std::string write = "MODE_REG := " + std::string(mode) + ";";
        EXPECT_EQ(of("INIT(V1);", write), "") << mode;
        EXPECT_EQ(of("V_SOLL := 500 rpm;", write), "") << mode;
        EXPECT_EQ(of("", "USE_SET(1); " + write), "") << mode;
        EXPECT_EQ(of("", "INIT(V1); " + write), "") << mode;
        EXPECT_EQ(of("INIT(A1, T1);", write), "W011") << mode;
        EXPECT_EQ(of("INIT(V1);", "STOP; " + write), "W004") << mode;
    }
    EXPECT_EQ(of("INIT(T1);", "MODE_REG := AT_MODE;"), "");
    EXPECT_EQ(of("T_SOLL := 300;", "MODE_REG := AT_MODE;"), "");
    EXPECT_EQ(of("INIT(V1);", "MODE_REG := AT_MODE;"), "W011");
    EXPECT_EQ(of("INIT(V1);", "MODE_REG := V_MODE;"), "W011");
}

// 001 §4.4.20 - §4.4.22
TEST(Diagnostics, ModesThatTakePlacesSelectThem) {
    const auto of = [](const std::string& registers, const std::string& mode) {
        return test::codes(
            compile("PROGRAM P MOTOR MAC140; VAR_MOTOR Fast AT V1 := 500 rpm; " + registers +
                    " END_VAR POWER_UP INIT(V1); NEXT := S; END_POWER_UP STEP S: OWN ERROR; IF "
                    "R_TRIG(IN0) THEN MODE_REG := " +
                    mode +
                    "; NEXT := Other; END_IF END_STEP STEP Other: OWN ERROR; IF "
                    "R_TRIG(IN1) THEN NEXT := POWER_UP; END_IF END_STEP END_PROGRAM"));
    };
    EXPECT_EQ(of("Left AT P1 := 100; Right AT P4 := 600; Side AT P6 := 1; Try AT V8 := 0;", "COIL_MODE"), "");
    EXPECT_EQ(of("Low AT P1 := 100; High AT P2 := 600;", "A2POS_MODE"), "");
    EXPECT_EQ(of("Low AT P1 := 100; Gain AT P2 := 600; Band AT P3 := 5;", "APOS_MODE"), "");
    EXPECT_EQ(of("Band AT P3 := 5;", "A2POS_MODE"), "W033");
    EXPECT_EQ(of("Far AT P7 := 5;", "COIL_MODE"), "W033");
}

TEST(Diagnostics, ColumnsCountCharacters) {
    const std::string source =
        "PROGRAM P (* \xC3\xA4\xC3\xB6 *) MOTR MAC140;\nSTEP S: OWN ERROR; END_STEP END_PROGRAM\n";
    EXPECT_EQ(position_of(source, static_cast<std::uint32_t>(source.find("MOTR"))).column, 20U);
}

TEST(Diagnostics, SeveralInOneRunInSourceOrder) {
    const std::string source =
        steps("IF G THEN NEXT := Othr; END_IF IF B THEN V_SOLL := 99999 rpm; NEXT := Fault; END_IF");
    EXPECT_EQ(test::codes(compile(source)), "E021 E021 E042") << test::shown(compile(source), source);
}

TEST(Diagnostics, SeveralSyntaxErrorsInOneRun) {
    const std::string source = test::program(
        "STEP S: IF A THEN NEXT = Other; END_IF END_STEP\n"
        "STEP T: IF B THEN NEXT := ; END_IF END_STEP\nSTEP 9: END_STEP");
    EXPECT_EQ(test::codes(compile(source)), "E010 E010 E010") << test::shown(compile(source), source);
}

TEST(Diagnostics, CutProgramsNeverCrash) {
    const std::string source = test::program(
        "STEP S: OUT W; ENTRY POSITION(P1); OUT X WHEN A XOR (B OR NOT C);\n"
        "IF A AND TIMER.Q THEN TIMER := T#1s500ms; V_SOLL := -1.5 rpm; NEXT := Other;\n"
        "ELSIF COUNTER.Q THEN EVERY_SCAN COUNT_DOWN; ELSE NEXT := POWER_UP; END_IF\n"
        "TERM 16#C1, 1,2,3,4,5,6,7; END_STEP");
    for (std::size_t length = 0; length + 1 < source.size(); ++length) {
        const std::string cut = source.substr(0, length);
        const Compilation result = compile(cut);
        EXPECT_FALSE(result.ok) << cut;
        EXPECT_FALSE(test::shown(result, cut).empty());
        compile(source.substr(length));
    }
}

TEST(Diagnostics, StrangeBytesAreOneMessage) {
    EXPECT_EQ(test::codes(compile(std::string(5000, '\0'))), "E001");
    EXPECT_EQ(test::codes(compile("")), "E010");
    EXPECT_EQ(test::codes(compile(" // nothing\n")), "E010");
    EXPECT_FALSE(compile("\xFF\xFE%\x80").ok);
}

TEST(Diagnostics, LongLinesAreCutAroundTheCaret) {
    // Q is character 10 + 8 + 11 + 2 + 600 + 11 + 1 = 643. Before it 40 are shown: 29 x and 11 others; from
    // it on 60: 5 and 55 y.
    const std::string source = "PROGRAM P STEP S: OWN ERROR; (*" + std::string(600, 'x') +
                               "*) NEXT := Q; (*" + std::string(600, 'y') + "*) END_STEP END_PROGRAM";
    const std::string text = test::shown(compile(source), source);
    const std::string line = "..." + std::string(29, 'x') + "*) NEXT := Q; (*" + std::string(55, 'y') + "...";
    EXPECT_EQ(text, "test.seq:1:643: error E021: there is no step 'Q'\n 1 | " + line + "\n   | " +
                        std::string(43, ' ') +
                        "^\n  help: write STEP Q: ... END_STEP, or name one of the steps there are\n");
}

TEST(Diagnostics, LongNamesAndManyOfThemStaySmall) {
    const std::string name(1'000'000, 'n');
    const std::string source = "PROGRAM P STEP S: OWN ERROR; NEXT := " + name + "; END_STEP END_PROGRAM";
    EXPECT_LT(test::shown(compile(source), source).size(), 1000U);
    std::string wide = "PROGRAM P STEP S: OWN ERROR; (*";
    for (int i = 0; i < 2000; ++i) wide += "\xC3\xA4";
    wide += "*) NEXT := Q; (*";
    for (int i = 0; i < 2000; ++i) wide += "\xE2\x82\xAC";
    wide += "*) END_STEP END_PROGRAM";
    const std::string shown = test::shown(compile(wide), wide);
    EXPECT_LT(shown.size(), 1000U);
    EXPECT_NE(shown.find("...\xC3\xA4"), std::string::npos) << shown;
    EXPECT_NE(shown.find("\xE2\x82\xAC..."), std::string::npos) << shown;
}

TEST(Diagnostics, LimitsAreWholeNumbers) {
    const auto help = [](const std::string& statement) {
        const Compilation result = compile(in_branch(statement));
        return result.diagnostics.empty() ? std::string() : result.diagnostics[0].help;
    };
    EXPECT_EQ(help("P1 := 99999999999;"), "it takes -67000000 .. 67000000");  // 001 §3.2.49
    EXPECT_EQ(help("INPOSWIN := 70000;").find_first_of(".+"), help("INPOSWIN := 70000;").find(" .. ") + 1);
}

TEST(Diagnostics, AnErrorBehindManyWarningsIsShown) {
    std::string source =
        "PROGRAM P MOTOR MAC140;\nSTEP S: OWN ERROR; NEXT := T; END_STEP STEP T: OWN ERROR;\n";
    for (int i = 0; i < 150; ++i) source += "IF FALSE THEN NEXT := S; END_IF\n";
    source += "NEXT := Q; END_STEP END_PROGRAM";
    const Compilation result = compile(source);
    ASSERT_EQ(result.diagnostics.size(), 100U);
    EXPECT_TRUE(result.more_diagnostics);
    EXPECT_EQ(result.diagnostics.back().code, "E021");
    EXPECT_FALSE(result.ok);
}

TEST(Diagnostics, ManyMistakesAreBounded) {
    std::string source = "PROGRAM P\n";
    for (int i = 0; i < 5000; ++i) source += "STEP S: IF Q THEN NEXT := Z; END_IF END_STEP\n";
    const Compilation result = compile(source + "END_PROGRAM");
    EXPECT_EQ(result.diagnostics.size(), 100U);
    EXPECT_TRUE(result.more_diagnostics);
}

}  // namespace
}  // namespace nplc::seqc
