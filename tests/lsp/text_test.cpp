#include "editing/text.h"

#include <gtest/gtest.h>

namespace nplc::seqc::analysis {
namespace {

// "aé" is 61 C3 A9, the smiling face F0 9F 98 80: 2 units of UTF-16, 4 of UTF-8.
const std::string kText = "a\xC3\xA9\xF0\x9F\x98\x80z\r\nb\rc\n";

TEST(Lines, CountCharactersAsTheClientDoes) {
    const Lines lines(kText);
    EXPECT_EQ(lines.place_of(7, Encoding::utf16), (Place{0, 4}));
    EXPECT_EQ(lines.place_of(7, Encoding::utf8), (Place{0, 7}));
    EXPECT_EQ(lines.offset_of({0, 4}, Encoding::utf16), 7U);
    EXPECT_EQ(lines.offset_of({0, 7}, Encoding::utf8), 7U);
}

TEST(Lines, EndWithEachOfTheThree) {
    const Lines lines(kText);
    ASSERT_EQ(lines.count(), 4U);
    EXPECT_EQ(lines.line(1), "b");
    EXPECT_EQ(lines.line(2), "c");
    EXPECT_EQ(lines.line(3), "");
}

TEST(Lines, APlaceBeyondIsTheEnd) {
    const Lines lines(kText);
    EXPECT_EQ(lines.offset_of({0, 99}, Encoding::utf16), 8U);
    EXPECT_EQ(lines.offset_of({99, 0}, Encoding::utf16), kText.size());
}

TEST(Lines, APlaceInsideOfACharacterIsBeforeIt) {
    const Lines lines(kText);
    EXPECT_EQ(lines.offset_of({0, 3}, Encoding::utf16), 3U);
    EXPECT_EQ(lines.offset_of({0, 5}, Encoding::utf8), 3U);
}

}  // namespace
}  // namespace nplc::seqc::analysis
