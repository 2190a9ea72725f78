// REGISTERS.md agrees with the map's rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "registers/gateway.h"

namespace nplc::registers::gateway {
namespace {

std::string document() {
    std::ifstream file(std::string(GATEWAY_FOLDER) + "/REGISTERS.md");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string line_of(const Row& row) {
    constexpr const char* kAccess[]{"read", "read, write", "write"};
    std::string number = std::to_string(row.number);
    if (row.count > 1) number += ".." + std::to_string(row.number + row.count - 1);
    return "| " + number + " | " + std::string(row.name) + " | " + kAccess[static_cast<int>(row.access)] +
           " | " + std::string(row.text) + " |\n";
}

TEST(GatewayMap, TheDocumentHasEachRow) {
    const std::string text = document();
    for (const Row& row : map())
        EXPECT_NE(text.find(line_of(row)), std::string::npos) << "write in REGISTERS.md: " << line_of(row);
}

TEST(GatewayMap, TheDocumentHasEachResult) {
    const std::string text = document();
    for (int code = 0; code < 256; ++code) {
        const std::string_view words = describe(static_cast<Result>(code));
        if (words == "unknown result") continue;
        EXPECT_NE(text.find("| " + std::to_string(code) + " | "), std::string::npos) << code;
        EXPECT_NE(text.find(std::string(words) + " |\n"), std::string::npos) << words;
    }
}

TEST(GatewayMap, TheDocumentHasEachReasonAndCommand) {
    const std::string text = document();
    for (int code = 0; code < 16; ++code) {
        const std::string_view word = name_of_log_code(static_cast<std::uint8_t>(code));
        EXPECT_NE(word, "unknown") << code;
        EXPECT_NE(text.find(" " + std::to_string(code) + " "), std::string::npos) << code;
    }
    EXPECT_EQ(name_of_log_code(40), "unknown");
    EXPECT_EQ(name_of_log_code(32), "the drive's fault");
    for (int code = 0; code < 256; ++code) {
        const std::string_view word = name_of(static_cast<Command>(code));
        if (word == "unknown command") continue;
        EXPECT_NE(text.find("| " + std::to_string(code) + " | " + std::string(word) + " |"),
                  std::string::npos);
    }
}

TEST(GatewayMap, EachWordIsSaidOnce) {
    const auto all_differ = [](auto first, int count) {
        using Value = decltype(first);
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < i; ++j)
                EXPECT_NE(name_of(static_cast<Value>(i)), name_of(static_cast<Value>(j))) << i << ", " << j;
        }
    };
    all_differ(RunState::stopped, 5);
    all_differ(Link::down, 4);
    all_differ(SafeReason::none, 15);
    all_differ(DriveFault::none, 12);
    EXPECT_EQ(name_of(static_cast<Link>(4)), "unknown");
}

TEST(GatewayMap, RowsAscendAndDoNotOverlap) {
    unsigned next = 1;
    for (const Row& row : map()) {
        EXPECT_GE(row.number, next) << row.name;
        next = row.number + unsigned{row.count};
        EXPECT_LE(next, 256U) << row.name;
        EXPECT_EQ(find(row.number), find(row.name));
    }
}

}  // namespace
}  // namespace nplc::registers::gateway
