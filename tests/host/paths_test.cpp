#include "host/paths.h"

#include <gtest/gtest.h>

namespace nplc::host {
namespace {

TEST(Paths, NamesStayUtf8) {
    EXPECT_TRUE(path_of("\xC3\xB6.seq").u8string() == u8"\u00F6.seq");
    for (const char* name : {"", "a", "/dev/ttyUSB0", "\xC3\xB6 \xCE\xA9.seq"})
        EXPECT_EQ(name_of(path_of(name)), name);
    EXPECT_EQ(name_of(path_of("a/\xCE\xA9.seq").replace_extension(".bin")), "a/\xCE\xA9.bin");
}

}  // namespace
}  // namespace nplc::host
