#include "host/text_file.h"

#include <gtest/gtest.h>

namespace nplc::host {
namespace {

std::string text_in(std::string bytes) {
    const std::string problem = make_text(bytes);
    return problem.empty() ? bytes : "refused: " + problem;
}

std::string utf16(const std::string& text, bool big_end_first) {
    std::string bytes;
    for (const char c : text) bytes += big_end_first ? std::string({'\0', c}) : std::string({c, '\0'});
    return bytes;
}

const std::string kUtf16 = "refused: it is text in UTF-16; save it as UTF-8";

TEST(TextFile, IsWhatItsAuthorSaw) {
    for (const char* same : {"", "a", "a\nb\n", "\xC3\xA4\n", "a\rb\n", "\x1A\n", "\xEF\xBB"})
        EXPECT_EQ(text_in(same), same);
    EXPECT_EQ(text_in("\xEF\xBB\xBF"
                      "a\n"),
              "a\n");
    EXPECT_EQ(text_in("a\n\x1A\x1A"), "a\n");
    EXPECT_EQ(text_in("a\r\n\r\nb\r\n"), "a\n\nb\n");
    EXPECT_EQ(text_in("a\r\rb\r"), "a\n\nb\n");
    EXPECT_EQ(text_in("\xEF\xBB\xBF"
                      "a\r\nb\rc\r\n\x1A"),
              "a\nb\rc\n");
}

TEST(TextFile, Utf16IsNamedWithAndWithoutItsMark) {
    EXPECT_EQ(text_in("\xFF\xFE" + utf16("PROGRAM", false)), kUtf16);
    EXPECT_EQ(text_in("\xFE\xFF" + utf16("PROGRAM", true)), kUtf16);
    EXPECT_EQ(text_in(utf16("PROGRAM", false)), kUtf16);
    EXPECT_EQ(text_in(utf16("PROGRAM", true)), kUtf16);
    EXPECT_EQ(text_in("\xFF\xFE"), kUtf16);
    EXPECT_EQ(text_in(std::string("ab\0c", 4)), "refused: it is no text, for it holds zeros");
    EXPECT_EQ(text_in(std::string("\0", 1)), "refused: it is no text, for it holds zeros");
}

// U+4E2D U+6587, with and without words between.
TEST(TextFile, Utf16OfAnyScriptIsKnown) {
    for (const bool big : {false, true}) {
        const std::string chinese = big ? "\x4E\x2D\x65\x87" : "\x2D\x4E\x87\x65";
        EXPECT_TRUE(is_utf16_text((big ? "\xFE\xFF" : "\xFF\xFE") + chinese));
        EXPECT_TRUE(is_utf16_text(chinese + chinese + chinese + utf16("\r\n", big)));
        EXPECT_TRUE(is_utf16_text(utf16("?ROGRAM", big) + chinese + utf16("\n", big)));
        EXPECT_FALSE(is_utf16_text(utf16("PROGRAM", big) + std::string(2, '\0'))) << "a zero is no character";
        EXPECT_FALSE(is_utf16_text(utf16("PROGRAM", big) + "\xFF\xFF"));
        EXPECT_FALSE(is_utf16_text(utf16("PROGRAM", big) + (big ? "\xDC\x01" : "\x01\xDC")))
            << "the second half of a pair alone";
    }
    EXPECT_FALSE(is_utf16_text("PROGRAM P")) << "no zeros";
    // One term as the manual has it, and the end: STATE 1, the timer 0.
    EXPECT_FALSE(
        is_utf16_text(std::string("\xC0\x01\x01\x02\x41\x01\0\0\x3F\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 16)));
}

TEST(TextFile, ATableThatBeginsAsTheMarkDoesIsNoText) {
    EXPECT_TRUE(is_utf16_text("\xFF\xFE" + utf16("a", false)));
    EXPECT_TRUE(is_utf16_text("\xFE\xFF" + utf16("a", true)));
    for (const std::string& bytes : {std::string(), std::string("\xFF\xFE"),
                                     std::string("\xFF\xFE\0\0\0\0\0\0", 8), std::string(8, '\xFF')})
        EXPECT_FALSE(is_utf16_text(bytes));
}

/// What a text is in lines, in whichever blocks it comes.
std::vector<std::string> lines_in(const std::string& bytes, std::size_t block) {
    std::vector<std::string> lines{""};
    TextPieces pieces([&](std::string_view piece, bool ends_line) {
        lines.back() += piece;
        if (ends_line) lines.emplace_back();
        return true;
    });
    for (std::size_t at = 0; at < bytes.size() && pieces.add(std::string_view(bytes).substr(at, block));)
        at += block;
    pieces.finish();
    if (!pieces.problem().empty()) return {"refused: " + pieces.problem()};
    lines.pop_back();
    return lines;
}

TEST(TextPieces, AreTheSameInAllBlocks) {
    using Lines = std::vector<std::string>;
    const std::string utf16_text = "\xFF\xFE" + utf16("PROGRAM", false);
    for (const std::size_t block : {1U, 2U, 3U, 5U, 7U, 1000U}) {
        EXPECT_EQ(lines_in("\xEF\xBB\xBF"
                           "a\r\n\r\nbc\rd\r\n\x1A\x1A",
                           block),
                  (Lines{"a", "", "bc\rd"}))
            << block;
        EXPECT_EQ(lines_in("ab\ncd", block), (Lines{"ab", "cd"})) << block;
        EXPECT_EQ(lines_in("", block), Lines{}) << block;
        EXPECT_EQ(lines_in(utf16_text, block), Lines{kUtf16}) << block;
        EXPECT_EQ(lines_in(std::string("abcdefg\0", 8), block),
                  Lines{"refused: it is no text, for it holds zeros"});
    }
    EXPECT_EQ(lines_in("a\rb\r\rc", 100), (Lines{"a", "b", "", "c"}));
}

TEST(TextPieces, ALineWithoutEndComesInPieces) {
    std::size_t longest = 0;
    std::size_t whole = 0;
    TextPieces pieces([&](std::string_view piece, bool) {
        longest = std::max(longest, piece.size());
        whole += piece.size();
        return true;
    });
    const std::string block(10'000, 'x');
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(pieces.add(block));
    pieces.finish();
    EXPECT_EQ(whole, 1'000'000U);
    EXPECT_LE(longest, TextPieces::kLongestPiece + block.size());
}

TEST(TextPieces, EndWhereNobodyWantsMore) {
    int taken = 0;
    TextPieces pieces([&](std::string_view, bool) { return ++taken < 2; });
    EXPECT_FALSE(pieces.add("a\nb\nc\nd\n"));
    pieces.finish();
    EXPECT_EQ(taken, 2);
}

}  // namespace
}  // namespace nplc::host
