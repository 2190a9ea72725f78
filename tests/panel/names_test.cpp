#include "panel/names.h"

#include <gtest/gtest.h>

namespace nplc::panel {
namespace {

TEST(PanelNames, TheScaleOfAProgram) {
    const faces::Scaling belt =
        scale_in(R"({"scale":{"revolutions":2.0,"length":5.0,"unit":"mm"},"table":{"crc32":"00000001"}})");
    EXPECT_EQ(belt.unit, "mm");
    EXPECT_EQ(belt.per_revolution, 2.5);
    EXPECT_EQ(in_words(belt), "2.5 mm a revolution");
    EXPECT_TRUE(is_same(belt, {.unit = "mm", .per_revolution = 2.5}));
    EXPECT_FALSE(is_same(belt, {.unit = "mm", .per_revolution = 5}));
    EXPECT_FALSE(is_same(belt, {.unit = "deg", .per_revolution = 2.5}));
    EXPECT_TRUE(is_same({.unit = "deg", .per_revolution = 360.0 / 7},
                        {.unit = "deg", .per_revolution = 1 / (7 / 360.0)}));
}

TEST(PanelNames, WithoutAScaleRevolutions) {
    for (const char* text :
         {"", "{", "[]", "{}", R"({"scale":null})", R"({"scale":"mm"})", R"({"scale":{"unit":"mm"}})",
          R"({"scale":{"revolutions":0,"length":5,"unit":"mm"}})",
          R"({"scale":{"revolutions":1,"length":5,"unit":7}})"})
        EXPECT_TRUE(is_same(scale_in(text), {})) << text;
}

// Its values are copied and written by functions that call themselves.
TEST(PanelNames, ADeepFileIsNotRead) {
    constexpr std::size_t kMany = 200'000;
    const std::string deep = R"({"table":{"crc32":"00000001"},"scale":{"unit":)" + std::string(kMany, '[') +
                             std::string(kMany, ']') + "}}";
    EXPECT_FALSE(is_for_table(deep, 1));
    EXPECT_TRUE(is_same(scale_in(deep), {}));
    EXPECT_TRUE(is_for_table(R"({"table":{"crc32":"00000001"},"x":[[{"y":[1]}]]})", 1));
}

}  // namespace
}  // namespace nplc::panel
