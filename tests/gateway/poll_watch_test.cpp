// Late polls, and how long an edge takes to its order: the figures of the boards' READMEs.

#include <gtest/gtest.h>

#include <random>

#include "port_bench.h"

namespace nplc::gateway {
namespace {

using sequencer::TermBytes;

/// IN0: NOP... an order (start to P1), and on to step 1, which waits for IN0 to go.
const Bytes kOrderAtEdge{TermBytes{0xC0, 0x01, 0x01, 0x01, 0x40, 0x00, 0x00, 0x00},
                         TermBytes{0xC1, 0x00, 0x01, 0x00, 0x60, 0x00, 0x00, 0x00}};
constexpr std::uint8_t kPolledLate = static_cast<std::uint8_t>(Event::polled_late);

class PollWatchTest : public testing::Test, protected PortBench {
  protected:
    void SetUp() override {
        ASSERT_TRUE(upload_and_activate(kOrderAtEdge));
        ASSERT_TRUE(command(reg::Command::run));
        run(5ms);
        ASSERT_EQ(state(), reg::RunState::running);
    }
    void poll_after(base::Microseconds gap) {
        board.now += gap;
        controller->poll(board.now);
    }
    std::vector<EventLog::Entry> late_events() const {
        std::vector<EventLog::Entry> found;
        for (std::size_t i = 0; i < EventLog::kSlots; ++i) {
            if (gateway->log().slot(i).event == kPolledLate) found.push_back(gateway->log().slot(i));
        }
        return found;
    }
};

TEST_F(PollWatchTest, InTimeNothingIsTold) {
    run(1s);
    EXPECT_EQ(read(reg::POLL_WORST), 250U);
    poll_after(5ms);
    EXPECT_EQ(read(reg::POLL_WORST), 5'000U) << "the limit itself is in time";
    EXPECT_EQ(read(reg::LATE_POLLS), 0U);
    EXPECT_TRUE(late_events().empty());
}

TEST_F(PollWatchTest, AnExcessIsOneEventWithItsLength) {
    poll_after(31ms);
    for (int i = 0; i < 99; ++i) poll_after(6ms);
    ASSERT_EQ(late_events().size(), 1U) << "one that goes on is no further event";
    EXPECT_EQ(late_events()[0].detail, 31U);
    EXPECT_EQ(read(reg::LATE_POLLS), 100U);
    EXPECT_EQ(read(reg::POLL_WORST), 31'000U);
    run(10s);
    poll_after(20ms);
    ASSERT_EQ(late_events().size(), 2U) << "after ten seconds in time it is the next one";
    EXPECT_EQ(late_events()[1].detail, 20U);
}

TEST_F(PollWatchTest, TheWorstIsForgottenWhenItIsWrittenAndWhenARunBegins) {
    poll_after(31ms);
    EXPECT_TRUE(write(reg::SCAN_WORST, 0));
    EXPECT_EQ(read(reg::POLL_WORST), 250U);
    poll_after(31ms);
    ASSERT_TRUE(command(reg::Command::stop));
    EXPECT_EQ(read(reg::POLL_WORST), 31'000U);
    ASSERT_TRUE(command(reg::Command::run));
    run(5ms);
    EXPECT_EQ(read(reg::POLL_WORST), 250U);
    EXPECT_EQ(read(reg::LATE_POLLS), 2U) << "since the start";
    EXPECT_FALSE(write(reg::LATE_POLLS, 0));
    EXPECT_EQ(result(), result_of(reg::Result::read_only, reg::LATE_POLLS));
}

TEST_F(PollWatchTest, TheLimitIsASetting) {
    ASSERT_TRUE(command(reg::Command::stop));
    ASSERT_TRUE(write(reg::register_of(store::Setting::poll_limit), 2'000));
    poll_after(1s);
    EXPECT_EQ(read(reg::LATE_POLLS), 0U) << "stopped, it may be busy with its flash";
    ASSERT_TRUE(command(reg::Command::run));
    run(5ms);
    poll_after(2ms + base::Microseconds(1));
    EXPECT_EQ(read(reg::LATE_POLLS), 1U);
}

TEST_F(PollWatchTest, WhatABoardSleptAsItWasToldIsNotLate) {
    gateway->clear_worst();
    const base::Instant due = controller->next_poll(board.now, board.now + 50ms);
    ASSERT_EQ(due, board.now + 50ms) << "nothing is to be done";
    poll_after(50ms);
    static_cast<void>(controller->next_poll(board.now, board.now + 50ms));
    poll_after(20ms);
    EXPECT_EQ(gateway->polls().worst(), 0U) << "woken by an edge";
    static_cast<void>(controller->next_poll(board.now, base::kNever));
    poll_after(std::chrono::hours(5));
    EXPECT_EQ(gateway->polls().worst(), 0U);
    static_cast<void>(controller->next_poll(board.now, board.now + 50ms));
    poll_after(63ms);
    EXPECT_EQ(gateway->polls().worst(), 13'000U);
    EXPECT_EQ(late_events().size(), 1U);
}

TEST_F(PollWatchTest, AcrossTheWrapOfTheMicroseconds) {
    board.now = base::Instant{base::Microseconds{0xFFFF'FFFF}} - 3ms;
    controller->poll(board.now);
    static_cast<void>(write(reg::SCAN_WORST, 0));
    const auto late = gateway->polls().late();
    for (int i = 0; i < 10; ++i) poll_after(1ms);
    EXPECT_GT(board.now, base::Instant{base::Microseconds{0xFFFF'FFFF}});
    poll_after(15ms);
    EXPECT_EQ(gateway->polls().worst(), 15'000U);
    EXPECT_EQ(gateway->polls().late(), late + 1);
}

/// An edge just behind a poll is seen at the next one, a gap later; it counts at the first poll that is a
/// debounce time after that, which comes a gap later at most; the scan of that poll gives the order. So
/// debounce + 2 gaps, of a motor that has finished what was ordered before, whatever the polls do within the
/// gap.
TEST_F(PollWatchTest, FromAnEdgeToItsOrderADebounceTimeAndTwoGapsAtMost) {
    constexpr unsigned kSeed = 29;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    std::mt19937 dice(kSeed);
    const auto between = [&dice](int least, int most) {
        return base::Microseconds(least + static_cast<int>(dice() % static_cast<unsigned>(most - least + 1)));
    };
    constexpr base::Microseconds kDebounce{3'000};
    for (const int gap : {250, 1'500, 10'000}) {
        base::Microseconds worst{};
        for (int edge = 0; edge < 2'000; ++edge) {
            board.room = 8;
            board.in = 0;
            for (int i = 0; i < 60; ++i) poll_after(between(gap / 2, gap));
            const std::size_t before = board.sent.size();
            const base::Instant next = board.now + between(gap / 2, gap);
            const base::Instant at = board.now + between(1, static_cast<int>((next - board.now).count()));
            board.in = 1;
            controller->poll(board.now = next);
            while (board.sent.size() == before) {
                ASSERT_LE(board.now - at, kDebounce + 2 * base::Microseconds(gap)) << gap;
                poll_after(between(gap / 2, gap));
            }
            worst = std::max(worst, board.now - at);
        }
        EXPECT_LE(worst, kDebounce + 2 * base::Microseconds(gap));
        EXPECT_GE(worst, kDebounce + base::Microseconds(gap)) << "the bound is far from what happens";
    }
}

}  // namespace
}  // namespace nplc::gateway
