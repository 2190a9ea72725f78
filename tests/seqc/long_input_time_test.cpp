// Nothing takes time that grows faster than the text: of the processor, as ratios of two lengths in one run.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "long_programs.h"
#include "seqc/format.h"
#include "seqc/symbol_file.h"
#include "support.h"

namespace nplc::seqc {
namespace {

void work_on(const std::string& source) {
    const Compilation result = compile(source);
    render_all(result, source, "long.seq");
    if (result.ok) {
        listing(result, source, "long.seq");
        write_symbols(result, source, "long.seq");
    }
    format_program(source);
}

double seconds_of(const std::string& source) {
    const std::clock_t start = std::clock();
    work_on(source);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// 16 times as long: 16 times the work, some 60 where memory comes slowly, 256 where it is quadratic. What
// takes less than 10 ms is not measured.
TEST(LongInputTime, GrowsAsTheTextDoes) {
    constexpr int kShort = 2'500, kLonger = 16;
    const auto shorter = test::long_programs(kShort), longer = test::long_programs(kShort * kLonger);
    for (std::size_t i = 0; i < shorter.size(); ++i) {
        const double once = std::max(0.01, seconds_of(shorter[i].source));
        EXPECT_LT(seconds_of(longer[i].source) / once, kLonger * kLonger / 2) << longer[i].what;
    }
}

TEST(LongInputTime, FourMegabytesOnOneLine) {
    constexpr std::size_t kLength = 250'000, kLonger = 16;  // to 4 MB, as long as a file may be
    for (const char* part : {"x", "(", "{", "\"", "'", "STEP S: ", "\xFF", "IF A THEN ", ";", "9"}) {
        std::string source = "PROGRAM P ";
        while (source.size() < kLength) source += part;
        const double once = std::max(0.01, seconds_of(source));
        while (source.size() < kLonger * kLength) source += part;
        EXPECT_LT(seconds_of(source) / once, kLonger * kLonger / 2) << part;
    }
}

}  // namespace
}  // namespace nplc::seqc
