// How long a scan's orders keep the line: by arithmetic from the driver's rules (firmware/motor/README.md),
// and against the driver and the motor on the simulated board.
#include "report/line_time.h"

#include <gtest/gtest.h>

#include <optional>

#include "random_table.h"
#include "sequencer/term.h"
#include "sim/world.h"

namespace nplc::seqc {
namespace {

using namespace std::chrono_literals;
using sequencer::MotorOrder;
using sequencer::Term;
using sim::Time;

constexpr MotorOrder kStop{.command = 0x65};
constexpr MotorOrder kWord{.is_register_write = true, .reg = 65, .value = 3146};
constexpr MotorOrder kLong{.is_register_write = true, .reg = 49, .longword = true, .value = 5120};

LineUse use(std::vector<MotorOrder> orders, bool safe = true) {
    return line_use(orders, safe);
}

TEST(LineTime, NothingSentTakesNoTime) {
    const LineUse none = use({});
    EXPECT_EQ(none.messages + none.characters + none.until_done + none.at_most, 0U);
}

// Safe: the command twice, then two equal status bytes. Rapid: once.
TEST(LineTime, ACommand) {
    EXPECT_EQ(use({kStop}).characters, 2U);
    EXPECT_EQ(use({kStop}).until_done, 2U + 2U);
    EXPECT_EQ(use({kStop}).at_most, 4U + 2U);
    EXPECT_EQ(use({kStop}, false).characters, 1U);
    EXPECT_EQ(use({kStop}, false).until_done, 1U + 2U);
    EXPECT_EQ(use({kStop, kStop, kStop}).until_done, 3U * 4U);
}

// 1Fh twice, answered at 4; pause until 2 + 3 = 5. Header 3, register 2, word 4: 9, left at 14; its status by
// 16; pause until 14 + 3 = 17. 7Eh three times: left at 20, its status by 22. Characters: 2 + 9 + 3.
TEST(LineTime, AWordWrite) {
    EXPECT_EQ(use({kWord}).messages, 3U);
    EXPECT_EQ(use({kWord}).characters, 14U);
    EXPECT_EQ(use({kWord}).until_done, 22U);
    EXPECT_EQ(use({kWord}).at_most, 22U + 3U * 2U);
    // Rapid: 1Fh once, answered at 3; pause until 1 + 3 = 4; the rest as above, one earlier.
    EXPECT_EQ(use({kWord}, false).characters, 13U);
    EXPECT_EQ(use({kWord}, false).until_done, 21U);
}

// A longword has 8 characters of data where a word has 4. Two writes share the switches: the second begins
// three characters after the first has left. 5 + 13 = 18; 18 + 3 + 9 = 30; 30 + 3 + 3 = 36, + 2. Then a
// command: 2 + 2.
TEST(LineTime, SeveralWritesAndACommand) {
    EXPECT_EQ(use({kLong}).characters, 2U + 13U + 3U);
    EXPECT_EQ(use({kLong, kWord}).until_done, 38U);
    EXPECT_EQ(use({kLong, kWord, kStop}).until_done, 42U);
    EXPECT_EQ(use({kStop, kLong, kWord}).until_done, 42U);
    // Back and forth: every change of protocol is paid for.
    EXPECT_EQ(use({kWord, kStop, kWord}).until_done, 22U + 4U + 22U);
}

// Raw tables may switch the link themselves; the driver follows.
TEST(LineTime, LinkCommandsInATable) {
    const MotorOrder rapid{.command = 0x6A};
    const MotorOrder flexmac{.command = 0x7F};
    EXPECT_EQ(use({rapid, kStop}).characters, 2U + 1U);
    EXPECT_EQ(use({flexmac}).messages, 2U);  // it is led back
    EXPECT_EQ(use({flexmac, kWord}).until_done, use({kWord}).until_done);
}

TEST(LineTime, Milliseconds) {
    EXPECT_DOUBLE_EQ(milliseconds(192, 19'200), 100);
    EXPECT_DOUBLE_EQ(milliseconds(1, 10'000), 1);
}

/// Steps 0 -> 1 at once; 1 -> 2 with IN0 and all of `orders`.
std::vector<std::uint8_t> table_that_sends(const std::vector<MotorOrder>& orders) {
    std::vector<Term> terms(1);
    terms[0].condition = {.step = 0};
    terms[0].fast.next_step = 1;
    for (const MotorOrder& order : orders) {
        Term term;
        term.condition = {.step = 1, .input = 1, .care = 1};
        term.is_flex = order.is_register_write;
        term.fast = {.sends = true, .command = order.command};
        term.flex = {.reg = order.reg,
                     .longword = order.longword,
                     .low_word = static_cast<std::uint16_t>(order.value),
                     .high_word = static_cast<std::uint16_t>(order.value >> 16)};
        terms.push_back(term);
    }
    terms.emplace_back();
    terms.back().condition = {.step = 1, .input = 1, .care = 1};
    terms.back().fast.next_step = 2;
    std::vector<std::uint8_t> table;
    for (const Term& term : terms) {
        const auto bytes = sequencer::encode(term);
        table.insert(table.end(), bytes.begin(), bytes.end());
    }
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

/// Runs the switch of step 1 on the simulated board.
struct Measured {
    std::optional<Time> done;    ///< from the scan until the driver is ready for the next
    std::size_t characters = 0;  ///< that left for the motor meanwhile
    std::uint32_t not_delivered = 0;
};

Measured measure(const std::vector<MotorOrder>& orders, bool safe, std::uint32_t baud, Time offset) {
    sim::WorldOptions options;
    options.safe_communication = safe;
    options.baud = baud;
    sim::World world(table_that_sends(orders), options);
    const auto run_until = [&](auto condition) {
        const Time limit = world.now() + 3s;
        while (!condition() && world.now() < limit) world.step(limit);
        return condition();
    };
    Measured measured;
    if (!run_until([&] { return world.gateway().state().step == 1; })) return measured;
    const Time settled = world.now() + offset;
    run_until([&] { return world.now() >= settled; });
    world.set_input(0, true);
    // The scan that switches begins with the first order.
    const auto sent = world.line().to_motor().counters().sent;
    if (!run_until([&] { return !world.on_their_way().empty() || world.gateway().state().step == 2; }))
        return measured;
    const Time begin = world.now();
    if (!run_until([&] { return world.gateway().state().step == 2 && world.driver().orders_complete(); }))
        return measured;
    measured.done = world.now() - begin;
    measured.characters = world.line().to_motor().counters().sent - sent;
    measured.not_delivered = world.driver().counters().discarded + world.driver().counters().resent;
    return measured;
}

/// Between what is computed at the least and at the most, where the driver's polls come on top: one before
/// the first message, and for each message one to see its end and one to end its pause.
void expect_within(const std::vector<MotorOrder>& orders, bool safe, std::uint32_t baud, Time offset) {
    const LineUse computed = line_use(orders, safe);
    const Measured measured = measure(orders, safe, baud, offset);
    ASSERT_TRUE(measured.done.has_value());
    EXPECT_EQ(measured.not_delivered, 0U);
    EXPECT_EQ(measured.characters, computed.characters);
    const double ms = static_cast<double>(measured.done->count()) / 1e6;
    constexpr double kPoll = 0.25;
    const double polls = kPoll * (1 + 2 * static_cast<double>(computed.messages));
    constexpr double kRounding = 0.001;
    EXPECT_GE(ms, milliseconds(computed.until_done, baud) - kRounding) << baud << " baud, safe " << safe;
    EXPECT_LE(ms, milliseconds(computed.at_most, baud) + polls) << baud << " baud, safe " << safe;
}

TEST(LineTime, IsWhatTheSimulatedBoardTakes) {
    const std::vector<std::vector<MotorOrder>> scans{
        {kStop},
        {kWord},
        {kLong},
        {kLong, kLong, kWord, kWord, kStop, kStop},
        {kWord, kStop, kWord},
        {kStop, kStop, kStop, kStop, kStop, kStop, kStop, kStop, kStop, kStop, kStop, kStop}};
    for (const auto& orders : scans) {
        for (const std::uint32_t baud : {9'600U, 19'200U, 115'200U}) {
            for (const bool safe : {true, false}) {
                for (const Time offset : {10'000us, 10'130us, 10'390us})
                    expect_within(orders, safe, baud, offset);
            }
        }
    }
}

TEST(LineTime, HoldsForRandomOrders) {
    constexpr unsigned kSeed = 33;
    test::Random random(kSeed);
    for (int round = 0; round < 60; ++round) {
        std::vector<MotorOrder> orders(1 + random() % 12);
        for (MotorOrder& order : orders) {
            if (random() % 2 == 0) {
                order = kLong;
                order.longword = random() % 2 == 0;
                order.value = random() % 1000;
            } else {
                order.command = static_cast<std::uint8_t>(random() % 0x20);  // INIT: the motor stands still
            }
        }
        SCOPED_TRACE("seed " + std::to_string(kSeed) + ", round " + std::to_string(round));
        expect_within(orders, random() % 2 == 0, 19'200, Time{10'000'000 + random() % 1'000'000});
    }
}

}  // namespace
}  // namespace nplc::seqc
