#include "host/printable.h"

#include <gtest/gtest.h>

namespace nplc::host {
namespace {

TEST(Printable, NothingThatATerminalWouldObey) {
    EXPECT_EQ(printable("a\tb \xC3\xA4 \xE2\x82\xAC"), "a\tb \xC3\xA4 \xE2\x82\xAC");
    EXPECT_EQ(printable("\x1b[31m\a\r\n\x7F"), "?[31m????");
    EXPECT_EQ(printable("\xC2\x9B[31m"), "?[31m");
    EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");
    EXPECT_EQ(printable("\x9B\xFF\xC3"), "???");
    EXPECT_EQ(printable_lines("a\x1b\nb\n"), "a?\nb\n");
}

TEST(Printable, AMessageHasNoLineWithoutEnd) {
    testing::internal::CaptureStderr();
    complain("a\x1b\nb");
    complain(std::string(5000, 'x'));
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(said.starts_with("a?\nb\nxxx")) << said;
    EXPECT_TRUE(said.ends_with("x...\n"));
    EXPECT_LT(said.size(), 1100U);
}

}  // namespace
}  // namespace nplc::host
