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

TEST(TextFile, ATableThatBeginsAsTheMarkDoesIsNoText) {
    EXPECT_TRUE(is_marked_utf16("\xFF\xFE" + utf16("a", false)));
    EXPECT_TRUE(is_marked_utf16("\xFE\xFF" + utf16("a", true)));
    for (const std::string& bytes : {std::string(), std::string("\xFF\xFE"),
                                     std::string("\xFF\xFE\0\0\0\0\0\0", 8), std::string(8, '\xFF')})
        EXPECT_FALSE(is_marked_utf16(bytes));
}

}  // namespace
}  // namespace nplc::host
