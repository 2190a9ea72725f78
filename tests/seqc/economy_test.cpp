// A step takes no more terms than a careful engineer finds by hand: economy.txt holds steps with such tables.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support.h"

namespace nplc::seqc {
namespace {

struct Example {
    std::string title;
    std::string steps;
    int step = 1;
    std::vector<std::uint8_t> table;
};

std::vector<Example> examples() {
    std::ifstream file(SEQC_ECONOMY);
    std::vector<Example> list;
    std::string line;
    while (std::getline(file, line)) {
        if (line.starts_with("# ")) {
            list.push_back({line.substr(2), "", 1, {}});
        } else if (list.empty() || line.empty()) {
            continue;
        } else if (line.starts_with("@")) {
            list.back().step = std::stoi(line.substr(1));
        } else if (line.starts_with(" ")) {
            list.back().steps += line + "\n";
        } else {
            std::istringstream bytes(line.substr(0, line.find("//")));
            for (unsigned byte = 0; bytes >> std::hex >> byte;)
                list.back().table.push_back(static_cast<std::uint8_t>(byte));
        }
    }
    return list;
}

/// Naming the own step, or writing the outputs that the step has anyway, is the same as nothing.
test::Scan meaning(test::Scan scan, int step, int own_outputs) {
    if (!scan.next) scan.next = step;
    if (!scan.outputs) scan.outputs = own_outputs;
    return scan;
}

TEST(Economy, NeverMoreTermsThanByHand) {
    const std::vector<Example> all = examples();
    ASSERT_GE(all.size(), 30U);
    for (const Example& example : all) {
        SCOPED_TRACE(example.title);
        const std::string source = test::program(example.steps);
        const Compilation result = compile(source);
        ASSERT_TRUE(result.ok) << test::shown(result, source);
        ASSERT_FALSE(example.table.empty());
        ASSERT_EQ(example.table.size() % 8, 0U);
        const int own_outputs = example.step == 0                                   ? 0
                                : example.steps.find("OUT W;") != std::string::npos ? 1
                                                                                    : 0;
        for (unsigned c = 0; c < 1024; ++c) {
            const test::Scan by_hand = test::scan_case(example.table, example.step, c);
            const test::Scan compiled = test::scan_case(result.table, example.step, c);
            ASSERT_EQ(meaning(by_hand, example.step, own_outputs),
                      meaning(compiled, example.step, own_outputs))
                << "case " << c << "\n"
                << listing(result, source, "test.seq");
        }
        EXPECT_LE(test::terms_of(result.table, example.step), static_cast<int>(example.table.size() / 8))
            << listing(result, source, "test.seq");
    }
}

}  // namespace
}  // namespace nplc::seqc
