#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

const std::string kGood =
    "PROGRAM P\nSTEP S:\n OWN ERROR;\n IF IN0 THEN NEXT := S; END_IF\nEND_STEP\nEND_PROGRAM\n";

std::string with_line_ends(const std::string& text, const std::string& end) {
    std::string result;
    for (char c : text) result += c == '\n' ? end : std::string(1, c);
    return result;
}

/// Compiled and rendered; both must end, with at least one diagnostic if it is wrong and none too long.
std::string shown(const std::string& source) {
    const Compilation result = compile(source);
    EXPECT_EQ(result.ok, !result.table.empty());
    const std::string text = render_all(result, source, "x.seq", Colour::on);
    EXPECT_TRUE(result.ok || !text.empty());
    EXPECT_LT(text.size(), 200'000U);
    return text;
}

TEST(StrangeInput, LineEndsAndAByteOrderMarkDoNotMatter) {
    const std::vector<std::uint8_t> table = compile(kGood).table;
    ASSERT_FALSE(table.empty());
    EXPECT_EQ(compile(with_line_ends(kGood, "\r\n")).table, table);
    EXPECT_EQ(compile(with_line_ends(kGood, "\r")).table, table);
    EXPECT_EQ(compile("\xEF\xBB\xBF" + kGood).table, table);
}

TEST(StrangeInput, ACarriageReturnIsNoPartOfTheShownLine) {
    const std::string source = "PROGRAM P\r\nSTEP S: OWN ERROR; NEXT := Q; END_STEP\r\nEND_PROGRAM\r\n";
    EXPECT_EQ(test::shown(compile(source), source).find('\r'), std::string::npos);
    EXPECT_EQ(position_of(source, static_cast<std::uint32_t>(source.find("Q;"))).line, 2U);
}

TEST(StrangeInput, ZeroBytes) {
    for (std::size_t at = 0; at <= kGood.size(); ++at) {
        std::string source = kGood;
        source.insert(at, 1, '\0');
        EXPECT_EQ(shown(source).find('\0'), std::string::npos) << at;
    }
}

TEST(StrangeInput, BytesThatAreNoUtf8ShowAsQuestionMarks) {
    const std::string source =
        "PROGRAM P STEP S: OWN ERROR; (*\xFF\xC3\x9B[31m*) NEXT := Q; END_STEP END_PROGRAM";
    // FF and C3 9B (U+00DB) come as '?' and as they are; Q stands 6 + 2 characters behind "(*".
    const std::string text = test::shown(compile(source), source);
    EXPECT_NE(text.find("(*?\xC3\x9B[31m*) NEXT := Q;"), std::string::npos) << text;
    const std::string control =
        "PROGRAM P STEP S: OWN ERROR; (*\xC2\x9B[31m\x1b[31m\x80*) NEXT := Q; END_STEP END_PROGRAM";
    const std::string safe = test::shown(compile(control), control);
    EXPECT_NE(safe.find("(*?[31m?[31m?*) NEXT := Q;"), std::string::npos) << safe;
}

TEST(StrangeInput, TheCaretStandsUnderItsPlaceWhateverComesBefore) {
    const std::string source = "(*\xFF\x80\xC3\xA4\t*) Q";
    const std::string text = test::shown(compile(source), source);
    EXPECT_NE(text.find(" 1 | (*??\xC3\xA4\t*) Q\n   |      \t   ^\n"), std::string::npos) << text;
}

TEST(StrangeInput, AMegabyteOnOneLine) {
    for (const std::string& part :
         {std::string("x"), std::string("("), std::string("STEP S: "), std::string("\xFF"),
          std::string("IF A THEN "), std::string(";"), std::string("9")}) {
        std::string source = "PROGRAM P ";
        while (source.size() < 1'000'000) source += part;
        EXPECT_LT(shown(source).size(), 200'000U) << part;
    }
}

TEST(StrangeInput, MoreThan16MiBIsRefusedAtOnce) {
    EXPECT_EQ(test::codes(compile(std::string((16U << 20) + 1, ' '))), "E001");
}

TEST(StrangeInput, DeepNesting) {
    for (const std::string& part : {std::string("("), std::string("NOT "), std::string("NOT (")}) {
        std::string source = "PROGRAM P STEP S: OWN ERROR; IF ";
        for (int i = 0; i < 100'000; ++i) source += part;
        EXPECT_NE(shown(source).find("E013"), std::string::npos) << part;
    }
    std::string ifs = "PROGRAM P STEP S: OWN ERROR; ";
    for (int i = 0; i < 20'000; ++i) ifs += "IF IN0 THEN ";
    EXPECT_NE(shown(ifs).find("E064"), std::string::npos);
}

TEST(StrangeInput, UnterminatedEverything) {
    for (const std::string source : {"PROGRAM",
                                     "PROGRAM P",
                                     "PROGRAM P VAR_INPUT",
                                     "PROGRAM P VAR_INPUT A",
                                     "PROGRAM P VAR_INPUT A AT",
                                     "PROGRAM P VAR_INPUT A AT %",
                                     "PROGRAM P VAR_INPUT A AT %IX0.",
                                     "PROGRAM P VAR_MOTOR A AT REG(",
                                     "PROGRAM P VAR_MOTOR A AT REG(33",
                                     "PROGRAM P VAR_MOTOR A AT P1 :=",
                                     "PROGRAM P VAR_MOTOR A AT P1 := -",
                                     "PROGRAM P VAR_MOTOR A AT P1 := 16#",
                                     "PROGRAM P VAR_MOTOR A AT P1 := 5 rev/",
                                     "PROGRAM P SCALE",
                                     "PROGRAM P SCALE 1 rev =",
                                     "PROGRAM P ON",
                                     "PROGRAM P ON ERROR NEXT :=",
                                     "PROGRAM P POWER_UP",
                                     "PROGRAM P STEP",
                                     "PROGRAM P STEP S",
                                     "PROGRAM P STEP S: OUT",
                                     "PROGRAM P STEP S: OUT W WHEN",
                                     "PROGRAM P STEP S: OWN",
                                     "PROGRAM P STEP S: ENTRY",
                                     "PROGRAM P STEP S: IF",
                                     "PROGRAM P STEP S: IF NOT",
                                     "PROGRAM P STEP S: IF (",
                                     "PROGRAM P STEP S: IF IN0 AND",
                                     "PROGRAM P STEP S: IF TIMER.",
                                     "PROGRAM P STEP S: IF ANY",
                                     "PROGRAM P STEP S: IF IN0 THEN",
                                     "PROGRAM P STEP S: IF IN0 THEN NEXT :=",
                                     "PROGRAM P STEP S: IF IN0 THEN INIT(",
                                     "PROGRAM P STEP S: IF IN0 THEN INIT(V1,",
                                     "PROGRAM P STEP S: IF IN0 THEN TIMER := T#",
                                     "PROGRAM P STEP S: IF IN0 THEN X",
                                     "PROGRAM P TERM",
                                     "PROGRAM P TERM 1,",
                                     "PROGRAM P (*",
                                     "PROGRAM P //",
                                     "(",
                                     "%",
                                     "T#",
                                     "16#",
                                     "-",
                                     "\xEF\xBB",
                                     "\xEF\xBB\xBF"}) {
        const Compilation result = compile(source);
        EXPECT_FALSE(result.ok) << source;
        EXPECT_LE(result.diagnostics.size(), 3U) << source << "\n" << test::shown(result, source);
        EXPECT_FALSE(shown(source).empty());
    }
}

TEST(StrangeInput, AnyBytesAtAll) {
    constexpr unsigned kSeed = 20260;
    test::Random random(kSeed);
    for (int i = 0; i < 3000; ++i) {
        std::string source = kGood;
        for (int k = 0; k < 8; ++k) source[random() % source.size()] = static_cast<char>(random() & 0xFFU);
        shown(source);
    }
    RecordProperty("seed", static_cast<int>(kSeed));
}

}  // namespace
}  // namespace nplc::seqc
