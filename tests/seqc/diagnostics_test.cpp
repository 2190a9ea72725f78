#include <gtest/gtest.h>

#include <set>

#include "support.h"

namespace nplc::seqc {
namespace {

struct Row {
    const char* code;
    const char* marked;  ///< the text under the caret's start; empty: not checked
    std::string source;
};

std::string steps(const std::string& body) {
    return test::program("STEP S: OUT W; " + body + "\nEND_STEP");
}
std::string in_branch(const std::string& statements) {
    return steps("IF A THEN " + statements + " NEXT := Other; END_IF");
}
std::string motor(const std::string& declarations) {
    return "PROGRAM P MOTOR MAC140;\n" + declarations + "\nSTEP S: OWN ERROR; END_STEP END_PROGRAM";
}

std::string too_many_steps() {
    std::string text = "PROGRAM P\n";
    for (int i = 1; i <= 62; ++i) {
        text += "STEP N" + std::to_string(i) + ": OWN ERROR; NEXT := N" + std::to_string(i % 62 + 1) +
                "; END_STEP\n";
    }
    return text + "END_PROGRAM";
}

std::string deep() {
    return steps("IF " + std::string(200, '(') + "A" + std::string(200, ')') + " THEN NEXT := Other; END_IF");
}

std::string many_terms() {
    std::string text = "PROGRAM P\n";
    for (int i = 0; i < 1100; ++i) text += "TERM 16#C1,0,0,16#3E,16#80,0,0,0;\n";
    return text + "END_PROGRAM";
}

std::string too_many_terms() {
    // A XOR .. XOR F holds in 32 of 64 cases, no two of them neighbours: 32 terms a step, 33 steps.
    std::string text = "PROGRAM P\n";
    for (int i = 1; i <= 33; ++i) {
        text += "STEP N" + std::to_string(i) +
                ": OWN ERROR; IF IN0 XOR IN1 XOR IN2 XOR IN3 XOR IN4 XOR IN5 THEN NEXT := N" +
                std::to_string(i % 33 + 1) + "; END_IF END_STEP\n";
    }
    return text + "END_PROGRAM";
}

const std::vector<Row>& rows() {
    static const std::vector<Row> all = {
        {"E001", "$", steps("IF A $ THEN NEXT := Other; END_IF")},
        {"E002", "(* never", "PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM (* never"},
        {"E003", "16#G", in_branch("INPOSWIN := 16#G;")},
        {"E004", "T#5x", in_branch("TIMER := T#5x;")},
        {"E004", "T#5ms1s", in_branch("TIMER := T#5ms1s;")},
        {"E010", "NEXT", steps("IF A NEXT := Other; END_IF")},
        {"E010", "", steps("IF A THEN NEXT := Other END_IF")},
        {"E010", "PRGRAM", "PRGRAM P END_PROGRAM"},
        {"E010", "STPE", "PROGRAM P\nSTPE X: END_STEP\nSTEP S: OWN ERROR; END_STEP END_PROGRAM"},
        {"E011", "STEP", motor("VAR_INPUT STEP AT IN0 : BOOL; END_VAR")},
        {"E011", "V1", motor("VAR_INPUT V1 AT IN0 : BOOL; END_VAR")},
        {"E011", "IN3", motor("VAR_INPUT IN3 AT IN0 : BOOL; END_VAR")},
        {"E012", "", "PROGRAM P STEP S: OWN ERROR; "},
        {"E013", "(", deep()},
        {"E014", "TIMER", steps("IF TIMER THEN NEXT := Other; END_IF")},
        {"E020", "Pump",
         motor("VAR_OUTPUT Pump AT OUT0 : BOOL; END_VAR VAR_INPUT Pump AT IN1 : BOOL; END_VAR")},
        {"E020", "s:", "PROGRAM P STEP S: OWN ERROR; END_STEP STEP s: OWN ERROR; END_STEP END_PROGRAM"},
        {"E021", "Othr", steps("IF A THEN NEXT := Othr; END_IF")},
        {"E021", "G ", steps("IF G THEN NEXT := Other; END_IF")},
        {"E021", "RESET_EROR", in_branch("RESET_EROR;")},
        {"E022", "%IX0.6", motor("VAR_INPUT Key AT %IX0.6 : BOOL; END_VAR")},
        {"E022", "IN7", steps("IF IN7 THEN NEXT := Other; END_IF")},
        {"E022", "%QX0.0", motor("VAR_INPUT Key AT %QX0.0 : BOOL; END_VAR")},
        {"E022", "IN0 : BOOL; END", motor("VAR_INPUT k AT IN0 : BOOL; m AT IN0 : BOOL; END_VAR")},
        {"E023", "W ", steps("IF W THEN NEXT := Other; END_IF")},
        {"E023", "A;", steps("OUT A;")},
        {"E030", "MAC145", "PROGRAM P MOTOR MAC145; STEP S: OWN ERROR; END_STEP END_PROGRAM"},
        {"E031", "V1",
         "PROGRAM P VAR_MOTOR Fast AT V1 := 5; END_VAR STEP S: OWN ERROR; END_STEP END_PROGRAM"},
        {"E032", "SCALE", motor("SCALE 5 mm = 1 rev;")},
        {"E032", "rpm", motor("SCALE 1 rev = 5 rpm;")},
        {"E040", "P9", motor("VAR_MOTOR far AT P9 := 5; END_VAR")},
        {"E040", "4)", in_branch("REG(4) := 1;")},
        {"E041", "UV_HANDLE", in_branch("UV_HANDLE := 1;")},
        {"E041", "0)", in_branch("REG(0) := 1;")},
        {"E041", "128", in_branch("REG(128) := 1;")},
        {"E042", "20000 rpm", in_branch("V_SOLL := 20000 rpm;")},
        {"E042", "-1", in_branch("A_SOLL := -1;")},
        {"E042", "16#10000", in_branch("INPOSWIN := 16#10000;")},
        {"E042", "1 rpm/s", in_branch("A1 := 1 rpm/s;")},
        {"E042", "0.0001", in_branch("L1 := 0.0001;")},
        {"E043", "mm", in_branch("P1 := 5 mm;")},
        {"E043", "rpm", in_branch("P1 := 5 rpm;")},
        {"E043", "500", in_branch("TIMER := 500;")},
        {"E050", "INIT", in_branch("INIT();")},
        {"E050", "INPOSWIN", in_branch("INIT(INPOSWIN);")},
        {"E050", "V2", in_branch("INIT(V1, V2);")},
        {"E050", "STOP", in_branch("STOP(V1);")},
        {"E050", "USE_SET", in_branch("USE_SET(5);")},
        {"E051", "SAFE_COMM", in_branch("SAFE_COMMUNICATION;")},
        {"E051", "USE_FLEXMAC", in_branch("USE_FLEXMAC;")},
        {"E052", "POSITION", in_branch("INIT(V1); POSITION(V2, P1);")},
        {"E052", "VELOCITY", in_branch("INIT(V1); VELOCITY(A1);")},
        {"E060", "STOP", steps("IF A THEN STOP; END_IF")},
        {"E060", "COUNT_DOWN", steps("COUNT_DOWN;")},
        {"E060", "TIMER", steps("IF A THEN TIMER := T#1s; END_IF")},
        {"E060", "STOP", steps("IF A THEN STOP; NEXT := S; END_IF")},
        {"E061", "NEXT := S", steps("IF A THEN NEXT := Other; NEXT := S; END_IF")},
        {"E061", "TIMER := T#2s", in_branch("TIMER := T#1s; TIMER := T#2s;")},
        {"E061", "COUNTER", in_branch("COUNT_DOWN; COUNTER := 5;")},
        {"E062", "T#1m6s", in_branch("TIMER := T#1m6s;")},
        {"E063", "65536", in_branch("COUNTER := 65536;")},
        {"E064", "IF B", steps("IF A THEN IF B THEN NEXT := Other; END_IF END_IF")},
        {"E064", "OUT X", steps("IF A THEN OUT X; NEXT := Other; END_IF")},
        {"E064", "NEXT", steps("ENTRY NEXT := Other;")},
        {"E064", "IF IN0",
         "PROGRAM P POWER_UP IF IN0 THEN NEXT := S; END_IF NEXT := S; END_POWER_UP STEP S: OWN ERROR; "
         "END_STEP END_PROGRAM"},
        {"E070", "B THEN", steps("IF A THEN NEXT := Other; END_IF IF B THEN NEXT := Fault; END_IF")},
        {"E071", "STOP", steps("IF NOT TIMER.Q THEN STOP; NEXT := Other; END_IF")},
        {"E072", "STOP", steps("IF TIMER.Q OR COUNTER.Q THEN STOP; NEXT := Other; END_IF")},
        {"E080", "S:", "PROGRAM P STEP S: END_STEP END_PROGRAM"},
        {"E081", "S:", "PROGRAM P ON ERROR NEXT := S; STEP S: END_STEP END_PROGRAM"},
        {"E082", "ERROR AND", steps("IF ERROR AND A THEN NEXT := Other; END_IF")},
        {"E083", "N62", too_many_steps()},
        {"E084", "P ", "PROGRAM P END_PROGRAM"},
        {"E085", "POWER_UP", "PROGRAM P POWER_UP STOP; END_POWER_UP STEP S: OWN ERROR; END_STEP END_PROGRAM"},
        {"E086", "P\n", too_many_terms()},
        {"E090", "256", "PROGRAM P TERM 256,0,0,0,0,0,0,0; END_PROGRAM"},
        {"E090", "TERM", "PROGRAM P TERM 1,2,3; END_PROGRAM"},
        {"E091", "TERM 0", "PROGRAM P TERM 16#3F,0,0,0,0,0,0,0; TERM 0,0,0,0,0,0,0,0; END_PROGRAM"},
        {"E092", "TERM", steps("TERM 16#C2,0,0,16#3E,16#80,0,0,0;")},
        {"W001", "A AND NOT A", steps("IF A AND NOT A THEN NEXT := Other; END_IF")},
        {"W001", "A AND B", steps("IF A THEN NEXT := Other; ELSIF A AND B THEN NEXT := Fault; END_IF")},
        {"W002", "700 rpm/s", in_branch("A_SOLL := 700 rpm/s;")},  // 2.8 steps of 248.4 rpm/s
        {"E042", "100 rpm/s", in_branch("A_SOLL := 100 rpm/s;")},
        {"W003", "5", in_branch("KIFX2 := 5;")},
        {"W004", "POSITION",
         "PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; IF IN0 THEN STOP; NEXT := T; END_IF END_STEP STEP "
         "T: OWN ERROR; IF IN1 THEN POSITION(P1); NEXT := S; END_IF END_STEP END_PROGRAM"},
        {"W005", "Lost",
         test::program("STEP S: IF A THEN NEXT := Other; END_IF END_STEP STEP Lost: END_STEP")},
        {"W006", "EVERY_SCAN", in_branch("EVERY_SCAN STOP;")},
        {"W007", "T#0s", in_branch("TIMER := T#0s;")},
        {"W008", "W WHEN", steps("OUT W WHEN A;")},
        {"W009", "TERM", "PROGRAM P TERM 0,0,0,16#3F,16#80,0,0,0; END_PROGRAM"},
        {"W009", "TERM", "PROGRAM P TERM 0,0,16#80,16#80,1,0,0,0; END_PROGRAM"},
        {"W010", "P\n", many_terms()},
        {"W011", "MODE_REG", in_branch("MODE_REG := 2;")},
    };
    return all;
}

TEST(Diagnostics, EachCodeAtItsPlace) {
    for (const Row& row : rows()) {
        const Compilation result = compile(row.source);
        const Diagnostic* found = nullptr;
        for (const Diagnostic& d : result.diagnostics) {
            if (d.code == row.code && found == nullptr) found = &d;
        }
        ASSERT_NE(found, nullptr) << row.code << " wanted for\n"
                                  << row.source << "\n"
                                  << test::shown(result, row.source);
        const std::string_view at = std::string_view(row.source).substr(found->span.offset);
        EXPECT_TRUE(at.starts_with(row.marked))
            << row.code << " points at " << at.substr(0, 20) << ", not at " << row.marked << "\n"
            << test::shown(result, row.source);
        EXPECT_EQ(result.ok, row.code[0] == 'W') << test::shown(result, row.source);
        EXPECT_FALSE(found->message.empty());
    }
}

TEST(Diagnostics, OneMistakeGivesOneMessage) {
    for (const Row& row : rows()) {
        if (row.code == std::string("E012") || row.code == std::string("E013")) continue;
        const Compilation result = compile(row.source);
        int errors = 0;
        for (const Diagnostic& d : result.diagnostics) errors += d.severity == Severity::error ? 1 : 0;
        EXPECT_LE(errors, 2) << row.code << "\n" << test::shown(result, row.source);
    }
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
    EXPECT_EQ(test::codes(compile(in_branch("MODE_REG := 0;"))), "");
    EXPECT_EQ(test::codes(compile(in_branch("VELOCITY(V1); MODE_REG := 2;"))), "");
    EXPECT_EQ(test::codes(compile(in_branch("INIT(V1); MODE_REG := 1;"))), "W011");
}

TEST(Diagnostics, ColumnsCountCharacters) {
    const std::string source =
        "PROGRAM P (* \xC3\xA4\xC3\xB6 *) MOTR MAC140;\nSTEP S: OWN ERROR; END_STEP END_PROGRAM\n";
    EXPECT_EQ(position_of(source, static_cast<std::uint32_t>(source.find("MOTR"))).column, 20U);
}

TEST(Diagnostics, MisspeltWordsAreGuessed) {
    const auto help = [](const std::string& source) {
        const Compilation result = compile(source);
        EXPECT_EQ(result.diagnostics.size(), 1U) << test::shown(result, source);
        return result.diagnostics.empty() ? std::string() : result.diagnostics[0].help;
    };
    EXPECT_EQ(help(in_branch("NXT := Other;")),
              "only constants can be written; another step is named with NEXT := Name;");
    EXPECT_EQ(help(in_branch("W := TRUE;")),
              "an output belongs to its step: OUT Name; or OUT Name WHEN condition;");
    EXPECT_EQ(help(in_branch("V_SOL := 5;")), "did you mean 'V_SOLL'?");
    EXPECT_EQ(help(in_branch("COUNTDOWN;")), "did you mean 'COUNT_DOWN'?");
    EXPECT_EQ(help(in_branch("POSITON(P1);")), "did you mean 'POSITION'?");
    EXPECT_EQ(help(steps("IF IMPOS THEN NEXT := Other; END_IF")), "did you mean 'INPOS'?");
    EXPECT_EQ(help(steps("IF A THEN NEXT := Ohter; END_IF")), "did you mean 'Other'?");
    EXPECT_EQ(help(motor("VAR_MOTOR v AT V1 := 5 mm/s; END_VAR")), "use rpm or rev/s");
}

TEST(Diagnostics, ACommandOfAnEntryIsPointedAt) {
    const std::string source = test::program(
        "STEP S: IF TIMER.Q AND A THEN NEXT := Other; ELSIF A THEN NEXT := T; END_IF END_STEP\n"
        "STEP T: ENTRY STOP; IF A THEN NEXT := Other; END_IF END_STEP");
    const Compilation result = compile(source);
    ASSERT_EQ(test::codes(result), "E071") << test::shown(result, source);
    EXPECT_EQ(source.substr(result.diagnostics[0].span.offset, 9), "NEXT := T");
    ASSERT_EQ(result.diagnostics[0].notes.size(), 1U);
    EXPECT_EQ(source.substr(result.diagnostics[0].notes[0].span.offset, 4), "STOP");
}

TEST(Diagnostics, TimerAndCounterConflictIsOneMessage) {
    const std::string source =
        steps("IF TIMER.Q THEN STOP; NEXT := Other; ELSIF COUNTER.Q THEN HOME; NEXT := Other; END_IF");
    EXPECT_EQ(test::codes(compile(source)), "E071") << test::shown(compile(source), source);
}

TEST(Diagnostics, OverlapShowsTheInputs) {
    const std::string source =
        steps("IF A AND NOT C THEN NEXT := Other; END_IF\nIF B THEN NEXT := Fault; END_IF");
    const Compilation result = compile(source);
    ASSERT_EQ(result.diagnostics.size(), 1U) << test::shown(result, source);
    EXPECT_EQ(result.diagnostics[0].message,
              "this and an earlier IF can hold together: A = 1, B = 1, C = 0, ERROR = 0");
    ASSERT_EQ(result.diagnostics[0].notes.size(), 1U);
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
                        std::string(43, ' ') + "^\n");
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
