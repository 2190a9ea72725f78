#include "seqc/format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "case_file.h"
#include "format/layout.h"
#include "language/lexer.h"
#include "seqc/seqc.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

using test::text_of_file;

std::string formatted(const std::string& source) {
    const Formatted result = format_program(source);
    EXPECT_TRUE(result.ok) << result.fault << source;
    for (const Diagnostic& d : result.diagnostics) ADD_FAILURE() << render(d, source, "test.seq");
    return result.text;
}

/// A program around some lines, as it should come out.
std::string around(const std::string& lines) {
    return "PROGRAM P\n\nSTEP S:\n    OWN ERROR;\n" + lines + "END_STEP\n\nEND_PROGRAM\n";
}

/// Without the parser, for what depends on the layout only.
std::string laid_out(const std::string& source) {
    Report report;
    std::vector<Token> comments;
    const std::vector<Token> tokens = tokens_of(source, report, &comments);
    EXPECT_FALSE(report.has_errors());
    return layout::lay_out(source, tokens, comments);
}

TEST(Format, TurnsEachGivenProgramIntoTheExpectedText) {
    const std::vector<test::Case> cases = test::read_cases(SEQC_FORMAT);
    for (const test::Case& one : cases) {
        EXPECT_EQ(formatted(one.input), one.expected) << one.name;
        EXPECT_EQ(formatted(one.expected), one.expected) << one.name;
        EXPECT_EQ(compile(one.expected).table, compile(one.input).table) << one.name;
    }
    EXPECT_GE(cases.size(), 8U);
}

TEST(Format, LeavesTheExamplesAsTheyAre) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(SEQC_EXAMPLES)) {
        if (entry.path().extension() != ".seq") continue;
        const std::string source = text_of_file(entry.path());
        EXPECT_EQ(formatted(source), source) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 3);
}

TEST(Format, LeavesADisassemblyAsItIs) {
    const std::string source = text_of_file(fs::path(SEQC_EXAMPLES) / "pick_and_place.seq");
    const std::string text = disassemble(compile(source).table, "Table").text;
    EXPECT_EQ(formatted(text), text);
}

TEST(Format, LineEndsAreLfAndTabsAndTheMarkAtTheBeginningGo) {
    EXPECT_EQ(formatted("\xEF\xBB\xBFPROGRAM P\r\n\r\nSTEP\tS:\r\n\tOWN\tERROR;\t// why \t\r\n"
                        "(* one\r\n\ttwo  \r\r\n*)\r\nEND_STEP\r\nEND_PROGRAM"),
              "PROGRAM P\n\nSTEP S:\n    OWN ERROR;                          // why\n"
              "    (* one\n\ttwo  \n*)\nEND_STEP\n\nEND_PROGRAM\n");
}

TEST(Format, AReturnWithinALineCommentStays) {
    EXPECT_EQ(formatted("PROGRAM P\n// a\rSTEP\r\nEND_PROGRAM\n"), "PROGRAM P\n// a\rSTEP\nEND_PROGRAM\n");
}

TEST(Format, WidthIsCountedInCharactersNotBytes) {
    // 4 + 18 columns of code each, so 18 blanks up to column 41; in bytes the first line is two longer.
    const std::string gap(18, ' ');
    EXPECT_EQ(
        formatted(around("    OUT OUT0 (* \xC2\xB5\xC2\xB5 *); // micro\n    OUT OUT1 (* mm *); // milli\n")),
        around("    OUT OUT0 (* \xC2\xB5\xC2\xB5 *);" + gap + "// micro\n    OUT OUT1 (* mm *);" + gap +
               "// milli\n"));
}

TEST(Format, ACommentBeforeElsifKeepsTheSideThatItsAuthorChose) {
    const std::string before = "    IF IN0 THEN\n        NEXT := S;\n";
    const std::string behind = "    ELSIF IN1 THEN\n        NEXT := S;\n    END_IF\n";
    for (const char* comment : {"        // of the IF\n", "    // of the ELSIF\n"})
        EXPECT_EQ(formatted(around(before + comment + behind)), around(before + comment + behind));
    EXPECT_EQ(formatted(around(before + "            // deep\n" + behind)),
              around(before + "        // deep\n" + behind));
    EXPECT_EQ(formatted(around(before + "// flat\n" + behind)), around(before + "    // flat\n" + behind));
}

TEST(Format, ACommentBelowOneBehindCodeBelongsToItOnlyInItsColumn) {
    const std::string code = "    OUT OUT0;  // first\n";
    const std::string first = "    OUT OUT0;                           // first\n";
    EXPECT_EQ(formatted(around(code + "               // more\n               // still\n")),
              around(first + std::string(40, ' ') + "// more\n" + std::string(40, ' ') + "// still\n"));
    EXPECT_EQ(formatted(around(code + "              // other\n")), around(first + "    // other\n"));
    EXPECT_EQ(formatted(around(code + "\n               // other\n")), around(first + "\n    // other\n"));
}

TEST(Format, NamesOfTheMotorInTheirOwnCase) {
    // 004 calls register 49 of the MAC800 by another name; P1 is found all the same and stays what it is.
    EXPECT_EQ(formatted("PROGRAM P motor mac800; POWER_UP p1 := 5; v_soll := 3; END_POWER_UP END_PROGRAM"),
              "PROGRAM P\nMOTOR MAC800;\n\nPOWER_UP\n    P1 := 5;\n    V_SOLL := 3;\nEND_POWER_UP\n\n"
              "END_PROGRAM\n");
}

TEST(Format, AWordMeansWhatItsPlaceSays) {
    EXPECT_EQ(
        formatted("PROGRAM P VAR_MOTOR home at p1; RPM at v1 := 5 RPM; q at a1; END_VAR\n"
                  "STEP stop: HOME; stop; position(HOME); v_soll := 1 RPM; velocity(rpm, Q);\n"
                  "IF timer.q THEN NEXT := STOP; END_IF unknown(Word); NEXT := Nowhere; END_STEP\n"
                  "END_PROGRAM"),
        "PROGRAM P\n\nVAR_MOTOR\n    home AT P1;\n    RPM  AT V1 := 5 rpm;\n    q    AT A1;\nEND_VAR\n\n"
        "STEP stop:\n    HOME;\n    STOP;\n    POSITION(home);\n    V_SOLL := 1 rpm;\n"
        "    VELOCITY(RPM, q);\n    IF TIMER.Q THEN NEXT := stop; END_IF\n    unknown(Word);\n"
        "    NEXT := Nowhere;\nEND_STEP\n\nEND_PROGRAM\n");
}

TEST(Format, StepNumbersAndTermsInSymbols) {
    EXPECT_EQ(laid_out("PROGRAM P STEP A at 5 : Out out0; term if IN0 And not ERROR then next:=b;out OUT0;"
                       "end_if; END_STEP STEP B AT 0: OUT OUT1; END_STEP\n"
                       "term a : if TIMER . q\nTHEN\nposition(p2); next:=B;end_if; END_PROGRAM"),
              "PROGRAM P\n\nSTEP A AT 5:\n    OUT OUT0;\n"
              "    TERM IF IN0 AND NOT ERROR THEN NEXT := B; OUT OUT0; END_IF;\nEND_STEP\n\n"
              "STEP B AT 0: OUT OUT1; END_STEP\n"
              "TERM A: IF TIMER.Q THEN POSITION(P2); NEXT := B; END_IF;\nEND_PROGRAM\n");
}

TEST(Format, ATermInSymbolsStaysOnOneLine) {
    std::string term = "TERM IF IN0";
    for (int i = 0; i < 20; ++i) term += " AND NOT IN1";
    const std::string source = "PROGRAM P\n" + term + " THEN NEXT := A; END_IF;\nEND_PROGRAM\n";
    EXPECT_EQ(laid_out(source), source);
}

TEST(Format, ItsOwnCheckSeesWhateverChanged) {
    const std::string good = "PROGRAM P\n// a\nSTEP S: OWN ERROR; END_STEP\n(* b *)\nEND_PROGRAM\n";
    EXPECT_EQ(layout::fault_between(good, good), "");
    EXPECT_EQ(layout::fault_between("program p // a \nstep s:own error;end_step(* b *)end_program",
                                    "PROGRAM p                               // a\n"
                                    "STEP s: OWN ERROR; END_STEP             (* b *)\nEND_PROGRAM\n"),
              "");
    const auto fault_with = [&](const std::string& from, const std::string& to) {
        std::string changed = good;
        return layout::fault_between(good, changed.replace(changed.find(from), from.size(), to));
    };
    for (const auto& [from, to] : {std::pair{"OWN", "ON"},
                                   {"ERROR;", "ERROR"},
                                   {"ERROR;", "ERROR;;"},
                                   {"STEP S", "STEPS"},
                                   {"// a\n", ""},
                                   {"// a", "// A"},
                                   {"(* b *)", "// b"},
                                   {"b *)", "b"},
                                   {"(* b *)\nEND_PROGRAM", "END_PROGRAM\n(* b *)"}}) {
        EXPECT_NE(fault_with(from, to).find("not be the same"), std::string::npos) << from << " -> " << to;
    }
    EXPECT_NE(fault_with("OWN", "own").find("change it again"), std::string::npos);
    EXPECT_NE(fault_with("// a", "  // a").find("change it again"), std::string::npos);
}

TEST(Format, SyntaxErrorsAreRefused) {
    const char* const programs[] = {
        "",
        "PROGRAM P",
        "PROGRAM P STEP S: OWN ERROR END_STEP END_PROGRAM",
        "PROGRAM P ? END_PROGRAM",
        "PROGRAM P (* END_PROGRAM",
        "PROGRAM P STEP IF: END_STEP END_PROGRAM",
        "PROGRAM P STEP S: IF A THEN IF B THEN STOP; END_IF END_IF END_STEP END_PROGRAM",
        "PROGRAM P END_PROGRAM PROGRAM Q END_PROGRAM"};
    for (const char* program : programs) {
        const Formatted result = format_program(program);
        EXPECT_FALSE(result.ok) << program;
        EXPECT_EQ(result.text, "") << program;
        EXPECT_EQ(result.fault, "") << program;
        EXPECT_FALSE(result.diagnostics.empty()) << program;
    }
    EXPECT_FALSE(format_program(std::string((16U << 20) + 1, ' ')).ok);
}

TEST(Format, OtherErrorsAreNone) {
    const std::string source =
        "PROGRAM P MOTOR X; MOTOR MAC140; SCALE 1 mm = 5 mm; TERM 1, 2; NEXT_STEP AT IN9; END_PROGRAM";
    EXPECT_FALSE(format_program(source).ok);  // NEXT_STEP is no item
    EXPECT_EQ(
        formatted("PROGRAM P MOTOR X; MOTOR mac140; SCALE 1 mm = 5 mm; TERM 1, 300;\n"
                  "STEP S: OUT Nothing; NEXT := Nowhere; V_SOLL := 9999999 rpm; END_STEP END_PROGRAM"),
        "PROGRAM P\nMOTOR X;\nMOTOR MAC140;\nSCALE 1 mm = 5 mm;\nTERM 1, 300;\n\nSTEP S:\n"
        "    OUT Nothing;\n    NEXT := Nowhere;\n    V_SOLL := 9999999 rpm;\nEND_STEP\n\nEND_PROGRAM\n");
}

/// A hundred mistakes end the parser's reading, so that the rest would be laid out unread.
TEST(Format, TooManyMistakesOfAnyKindAreRefused) {
    std::string source = "PROGRAM P\n";
    for (int i = 0; i < 120; ++i) source += "MOTOR MAC140;\n";
    const Formatted result = format_program(source + "END_PROGRAM\n");
    EXPECT_FALSE(result.ok);
    EXPECT_EQ(result.diagnostics.size(), 100U);
}

TEST(Format, ALineOfAnyLengthIsBroken) {
    std::string source = "PROGRAM P STEP S: OUT OUT0 WHEN IN0";
    for (int i = 0; i < 20'000; ++i) source += " OR IN0";
    const std::string text = formatted(source + "; END_STEP END_PROGRAM");
    std::istringstream lines(text);
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
    EXPECT_LE(longest, 120U);
    EXPECT_GT(longest, 113U);  // " OR IN0" of 7 columns would not have fitted
}

/// With the comment before it the line would be broken, and then the block would not be on one line any more.
TEST(Format, ABlockBehindAWideCommentIsLaidOutOnce) {
    const std::string comment = "(* " + std::string(70, 'c') + " *)";
    const std::string source =
        "PROGRAM P\n" + comment + " STEP S: IF IN0 AND IN1 THEN OUT_ := 1; END_IF END_STEP\nEND_PROGRAM\n";
    const std::string once = formatted(source);
    EXPECT_EQ(formatted(once), once);
    EXPECT_NE(once.find("STEP S:\n"), std::string::npos) << once;
}

TEST(Format, AResultThatIsNoProgramAnyMoreIsRefused) {
    // The first line is 72 columns wide, so all comments stand behind 74: 5 bytes become 77.
    std::string source = "PROGRAM P STEP S: OUT " + std::string(63, 'A');
    while (source.size() < 1'200'000) source += ",//\nA";
    const Formatted result = format_program(source + "; END_STEP END_PROGRAM");
    EXPECT_FALSE(result.ok);
    ASSERT_EQ(result.diagnostics.size(), 1U);
    EXPECT_EQ(result.diagnostics[0].code, "E001");
}

/// Columns that grow with the longest name would make a large text of a small one.
TEST(Format, LongNamesDoNotMakeTheTextGrow) {
    const std::string name(20'000, 'x');
    std::string source = "PROGRAM P VAR_INPUT " + name + " AT IN0; ";
    for (int i = 0; i < 2'000; ++i) source += "A AT IN1; // c\n";
    source += "END_VAR END_PROGRAM";
    EXPECT_LT(formatted(source).size(), 4 * source.size());
}

}  // namespace
}  // namespace nplc::seqc
