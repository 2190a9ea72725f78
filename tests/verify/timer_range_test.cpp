// A preset that stands for any time of a range: what is proved holds for each of them.
#include <gtest/gtest.h>

#include "analysis/verify.h"
#include "seqc/properties.h"

namespace nplc::verify {
namespace {

constexpr std::uint16_t kMark = 65'535;

/// Step 0: IN0 -> timer := kMark, step 1. Step 1: timer 0 -> step 2, OUT0. Step 2: IN0 off -> step 0.
const std::vector<std::uint8_t> kTable = {0xC0, 0x01, 0x01, 1, 0x80, 0, 0xFF, 0xFF,  //
                                          0x41, 0x00, 0x00, 2, 0x80, 1, 0,    0,     //
                                          0xC2, 0x00, 0x01, 0, 0x80, 0, 0,    0,     //
                                          0x3F, 0,    0,    0, 0,    0, 0,    0};

Verdict verdict(const std::string& form, std::uint16_t least, std::uint16_t most) {
    const auto loaded = sequencer::Table::load(kTable);
    EXPECT_TRUE(loaded.ok);
    const seqc::PropertyReading reading =
        seqc::read_properties("ASSUME NEVER ERROR; PROPERTY P: " + form + ";", {});
    EXPECT_TRUE(reading.diagnostics.empty());
    Options options;
    options.assume = Assume::driver;
    options.order_time = [](std::span<const sequencer::MotorOrder>) { return Delay{4, 8, 0}; };
    options.assumptions = reading.assumptions;
    options.ranges.timer = {{kMark, least, most}};
    for (const Result& result : verify(loaded.table, {}, reading.properties, options).results) {
        if (result.name == "P") return result.verdict;
    }
    return Verdict::undecided;
}

// The timer ends within `most`, and the scan that sees it begins 2 ms later at the latest: 20 + 2 < 30 < 50.
TEST(TimerRange, ADeadlineHoldsForTheWholeRange) {
    const std::string form = "WHENEVER step = 1 THEN step = 2 WITHIN 30 ms";
    EXPECT_EQ(verdict(form, 20, 20), Verdict::proved);
    EXPECT_EQ(verdict(form, 10, 20), Verdict::proved);
    EXPECT_NE(verdict(form, 10, 50), Verdict::proved) << "50 ms breaks it, 10 ms does not";
    EXPECT_NE(verdict(form, 50, 50), Verdict::proved);
}

TEST(TimerRange, WhatHangsOnNoTimeHoldsForAll) {
    EXPECT_EQ(verdict("ALWAYS POSSIBLE step = 2", 5, 60'000), Verdict::proved);
    EXPECT_EQ(verdict("NEVER step = 1 AND OUT0", 5, 60'000), Verdict::proved);
}

}  // namespace
}  // namespace nplc::verify
