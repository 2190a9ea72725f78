#include "base/json_depth.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::base {
namespace {

static_assert(!is_deeper("", 0));
static_assert(!is_deeper("1", 0));
static_assert(is_deeper("[]", 0));
static_assert(!is_deeper(R"([{"a":1}])", 2));
static_assert(is_deeper(R"([{"a":[]}])", 2));
static_assert(!is_deeper(R"([[],[],{},{}])", 2));
static_assert(!is_deeper(R"(["[[[{{{", "\"[[[\\", "[[["])", 1));
static_assert(is_deeper(R"(["\\",[[]]])", 2));
static_assert(!is_deeper("]]]]}}}[[]]", 2));
static_assert(!is_deeper("\"\\", 0));

TEST(JsonDepth, TheDeepestIsNotDeeper) {
    EXPECT_FALSE(is_deeper(std::string(16, '['), 16));
    EXPECT_TRUE(is_deeper(std::string(17, '['), 16));
}

}  // namespace
}  // namespace nplc::base
