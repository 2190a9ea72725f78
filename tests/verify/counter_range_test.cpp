// A preset of the counter that stands for any count of a range: proved holds for each of them, broken comes
// with one that breaks it.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "analysis/verify.h"
#include "seqc/properties.h"

namespace nplc::verify {
namespace {

constexpr std::uint8_t kRange = 100;
using Bytes = std::vector<std::uint8_t>;

/// Step 0: IN0 -> counter := kRange, step 1. Step 1: IN1 -> count down, step 2. Step 2: IN1 off -> step 1;
/// with the counter at 0 -> step 3. Step 3: IN0 off -> OUT0, step 0.
const Bytes kCounts = {0xC0, 0x01, 0x01, 0x41, 0x80, 0x00, kRange, 0,  //
                       0xC1, 0x02, 0x02, 0x02, 0x80, 0x80, 0,      0,  //
                       0xC2, 0x00, 0x02, 0x01, 0x80, 0x00, 0,      0,  //
                       0x82, 0x00, 0x02, 0x03, 0x80, 0x00, 0,      0,  //
                       0xC3, 0x00, 0x01, 0x00, 0x80, 0x01, 0,      0,  //
                       0x3F, 0,    0,    0,    0,    0,    0,      0};

Bytes with_count(Bytes table, std::uint8_t count) {
    for (std::size_t at = 0; at < table.size(); at += 8) {
        if (table[at + 6] == kRange) table[at + 6] = count;
    }
    return table;
}

std::vector<Result> results_of(const Bytes& table, const std::string& properties, Assume assume,
                               std::vector<PresetRange> ranges) {
    const auto loaded = sequencer::Table::load(table);
    EXPECT_TRUE(loaded.ok);
    const seqc::PropertyReading reading = seqc::read_properties("ASSUME NEVER ERROR; " + properties, {});
    EXPECT_TRUE(reading.diagnostics.empty());
    Options options;
    options.assume = assume;
    options.order_time = [](std::span<const sequencer::MotorOrder>) { return Delay{4, 8, 0}; };
    options.assumptions = reading.assumptions;
    options.ranges.counter = std::move(ranges);
    options.checks = false;
    return verify(loaded.table, {}, reading.properties, options).results;
}

Result result_of(const std::string& form, Assume assume, std::uint16_t least, std::uint16_t most) {
    return results_of(kCounts, "PROPERTY P: " + form + ";", assume, {{kRange, least, most}}).front();
}

TEST(CounterRange, WhatHoldsForEachCountIsProved) {
    for (const Assume assume : {Assume::any, Assume::driver}) {
        EXPECT_EQ(result_of("NEVER step = 1 AND COUNTER.Q", assume, 1, 50).verdict, Verdict::proved);
        EXPECT_EQ(result_of("NEVER step = 3 AND NOT COUNTER.Q", assume, 1, 50).verdict, Verdict::proved);
        EXPECT_EQ(result_of("ALWAYS POSSIBLE step = 3", assume, 1, 50).verdict, Verdict::proved);
        EXPECT_EQ(result_of("step = 3 IS REACHABLE", assume, 1, 50).verdict, Verdict::proved);
    }
}

// The first scan that counts down leaves 0 of 1, and of nothing else.
TEST(CounterRange, TheCountThatBreaksItIsTold) {
    const std::string form = "step = 2 AND COUNTER.Q ONLY AFTER step = 2 AND NOT COUNTER.Q";
    for (const Assume assume : {Assume::any, Assume::driver}) {
        EXPECT_EQ(result_of(form, assume, 2, 50).verdict, Verdict::proved);
        const Result broken = result_of(form, assume, 1, 50);
        EXPECT_EQ(broken.verdict, Verdict::broken);
        ASSERT_EQ(broken.presets.size(), 1U);
        EXPECT_EQ(broken.presets[0].preset, kRange);
        EXPECT_EQ(broken.presets[0].chosen, 1);
    }
}

/// Tables of four steps; one preset in three is the range.
Bytes random_table(std::mt19937& random) {
    const auto below = [&](unsigned end) { return static_cast<std::uint8_t>(random() % end); };
    Bytes table;
    const unsigned terms = 5 + below(8);
    for (unsigned i = 0; i < terms; ++i) {
        const std::uint8_t waits = random() % 2 == 0 ? 0xC0 : 0x80;
        const std::uint8_t count = std::array<std::uint8_t, 4>{0, 0x80, 0x80, 0x40}[below(4)];
        const bool presets = random() % 3 == 0;
        const Bytes term = {static_cast<std::uint8_t>(waits | below(4)),
                            below(4),
                            below(4),
                            static_cast<std::uint8_t>(0x40 | below(4)),
                            0x80,
                            static_cast<std::uint8_t>(below(2) | (presets ? 0 : count)),
                            static_cast<std::uint8_t>(presets ? kRange : 0),
                            0};
        table.insert(table.end(), term.begin(), term.end());
    }
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

constexpr const char* kForms =
    "PROPERTY P0: NEVER step = 3 AND COUNTER.Q; PROPERTY P1: ALWAYS POSSIBLE step = 2;"
    "PROPERTY P2: step = 3 AND COUNTER.Q IS REACHABLE; PROPERTY P3: ALWAYS POSSIBLE COUNTER.Q;"
    "PROPERTY P4: step = 1 ONLY AFTER COUNTER.Q AND step = 2; PROPERTY P5: COUNTER.Q CHANGES ONLY IN OUT0;"
    "PROPERTY P6: WHENEVER step = 1 THEN COUNTER.Q WITHIN 20 ms; PROPERTY P7: AFTER OUT0 ALWAYS POSSIBLE "
    "step = 3;";

TEST(CounterRange, VerdictsAreThoseOfEachCount) {
    constexpr std::uint8_t kMost = 4;
    std::size_t proved = 0;
    std::size_t broken = 0;
    for (unsigned seed = 0; seed < 150; ++seed) {
        std::mt19937 random(seed);
        const Bytes table = random_table(random);
        const Assume assume = seed % 2 == 0 ? Assume::any : Assume::driver;
        const auto ranged = results_of(table, kForms, assume, {{kRange, 1, kMost}});
        std::vector<std::vector<Result>> single;
        for (std::uint8_t count = 1; count <= kMost; ++count)
            single.push_back(results_of(with_count(table, count), kForms, assume, {}));
        for (std::size_t i = 0; i < ranged.size(); ++i) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", " + ranged[i].text);
            if (ranged[i].verdict == Verdict::proved) {
                ++proved;
                for (const auto& one : single) EXPECT_NE(one[i].verdict, Verdict::broken);
            } else if (ranged[i].verdict == Verdict::broken) {
                ++broken;
                const std::size_t count = ranged[i].presets.empty() ? 1 : ranged[i].presets[0].chosen;
                ASSERT_GE(count, 1U);
                ASSERT_LE(count, kMost);
                EXPECT_NE(single[count - 1][i].verdict, Verdict::proved) << count;
            }
        }
    }
    EXPECT_GT(proved, 250U);
    EXPECT_GT(broken, 250U);
}

}  // namespace
}  // namespace nplc::verify
