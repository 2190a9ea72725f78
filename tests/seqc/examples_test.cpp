#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "support.h"

namespace nplc::seqc {
namespace {

std::string text_of(const std::string& name) {
    std::ifstream file(std::string(SEQC_EXAMPLES) + "/" + name + ".seq");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

Compilation example(const std::string& name) {
    const std::string source = text_of(name);
    EXPECT_FALSE(source.empty()) << name;
    Compilation result = compile(read_sources(std::string(SEQC_EXAMPLES) + "/" + name + ".seq", source));
    EXPECT_TRUE(result.ok && result.diagnostics.empty()) << test::shown(result, source);
    return result;
}

TEST(Examples, CompileWithoutAWordAndComeBackFromTheirTables) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SEQC_EXAMPLES)) {
        if (entry.path().extension() != ".seq") continue;
        const Compilation result = example(entry.path().stem().string());
        const Disassembly text = disassemble(result.table, "Again");
        EXPECT_EQ(compile(text.text).table, result.table) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 8);
}

TEST(Examples, PickAndPlaceWalk) {
    const auto t = example("pick_and_place").table;
    const auto at = [&](int step, unsigned image, bool timer_zero) {
        return test::scan(t, step, image, timer_zero, true);
    };
    // Idle 1, Travel 2, Hold 3, Return 4, Fault 5, Cleared 6; Start 01h, Guard 02h, Ack 04h, INPOS 40h, ERROR
    // 80h.
    EXPECT_EQ(at(0, 0x00, true).sends,
              (std::vector<std::string>{"49=0L", "51=49152L", "65=3146", "73=81", "08", "10"}));
    EXPECT_EQ(at(0, 0x00, true).next, 1);
    EXPECT_EQ(at(0, 0x00, true).outputs, 8);
    EXPECT_EQ(at(1, 0x01, true), (test::Scan{.next = 2, .outputs = 1, .timer = 3000, .sends = {"41"}}));
    EXPECT_EQ(at(1, 0x03, true), test::Scan{});
    EXPECT_EQ(at(2, 0x42, true), (test::Scan{.next = 5, .outputs = 0, .sends = {"65"}}));
    EXPECT_EQ(at(2, 0x40, true), (test::Scan{.next = 3, .outputs = 0, .timer = 500}));
    EXPECT_EQ(at(2, 0x00, false), test::Scan{});
    EXPECT_EQ(at(2, 0x00, true), (test::Scan{.next = 5, .outputs = 0, .sends = {"65"}}));  // 3 s are over
    EXPECT_EQ(at(3, 0x40, false), test::Scan{});
    EXPECT_EQ(at(3, 0x40, true), (test::Scan{.next = 4, .outputs = 0, .timer = 3000, .sends = {"40"}}));
    EXPECT_EQ(at(3, 0x42, true), test::Scan{});  // no move starts at an open door
    EXPECT_EQ(at(4, 0x40, true), (test::Scan{.next = 1, .outputs = 8}));
    EXPECT_EQ(at(4, 0xC0, true), (test::Scan{.next = 5, .outputs = 0, .sends = {"65"}}));
    EXPECT_EQ(at(5, 0x84, true), (test::Scan{.next = 6, .outputs = 0, .sends = {"61"}}));
    EXPECT_EQ(at(6, 0x00, true), (test::Scan{.next = 0, .outputs = 0}));
    EXPECT_EQ(at(6, 0x04, true), test::Scan{});
}

TEST(Examples, FillAndCountCountsOnceForEachBottle) {
    const auto result = example("fill_and_count");
    const auto step = [&](const std::string& name) {
        for (std::size_t i = 0; i < 63; ++i) {
            if (result.symbols.steps[i] == name) return static_cast<int>(i);
        }
        return -1;
    };
    EXPECT_EQ(test::scan(result.table, 0, 0, true, true).counter, 12);
    EXPECT_TRUE(test::scan(result.table, step("Fill"), 0x03, true, false).counts);
    EXPECT_FALSE(test::scan(result.table, step("Fill"), 0x03, false, false).counts);
    EXPECT_EQ(test::scan(result.table, step("Filled"), 0x03, true, false).next, step("Filled_to_Away"));
    EXPECT_EQ(test::scan(result.table, step("Filled"), 0x03, true, true).next, step("Carton_Full"));
    EXPECT_EQ(test::scan(result.table, step("Carton_Full"), 0x04, true, true).counter, 12);
}

// 45 deg of the table = 10 / 8 rev of the motor = 1.25 x 4096 = 5120 counts; mode byte of P1: 40h.
TEST(Examples, IndexingTableMovesOnce) {
    const auto t = example("indexing_table").table;
    EXPECT_EQ(test::scan(t, 0, 0, true, true).sends,
              (std::vector<std::string>{"49=5120L", "65=1887", "73=40", "08", "10", "62", "64", "76"}));
    EXPECT_EQ(test::scan(t, 2, 0x01, true, true).sends, (std::vector<std::string>{"40"}));
    EXPECT_EQ(test::scan(t, 3, 0x01, false, true), test::Scan{});
}

}  // namespace
}  // namespace nplc::seqc
