#include "midi_client/feed.h"

#include <gtest/gtest.h>

namespace nplc::midi_client {
namespace {

constexpr std::int64_t kMs = 8'000;

Plan even(std::size_t axes, std::size_t segments, std::int32_t ms) {
    Plan plan;
    for (std::size_t i = 0; i < axes; ++i)
        plan.axes.push_back({static_cast<std::uint8_t>(i), std::vector<Segment>(segments, {false, ms, kMs})});
    return plan;
}

TEST(Feed, ThreeAtOnceThenOneForEachThatEnds) {
    const Plan plan = even(1, 5, 10);
    Feed feed(plan, 100 * kMs);
    // The lead-in runs until 100 ms, the segments end at 110, 120 ...
    const std::int64_t free[] = {0, 0, 0, 100, 110};
    const std::int64_t deadline[] = {100, 110, 120, 130, 140};
    for (std::size_t i = 0; i < 5; ++i) {
        const auto next = feed.next();
        ASSERT_TRUE(next);
        EXPECT_EQ(next->free, free[i] * kMs);
        EXPECT_EQ(next->deadline, deadline[i] * kMs);
        feed.taken(0);
    }
    EXPECT_FALSE(feed.next());
    EXPECT_EQ(feed.end(), 150 * kMs);
}

TEST(Feed, TakesTurns) {
    const Plan plan = even(2, 4, 10);
    Feed feed(plan, 100 * kMs);
    std::string order;
    while (const auto next = feed.next()) {
        order += static_cast<char>('a' + next->axis);
        feed.taken(next->axis);
    }
    EXPECT_EQ(order, "abababab");
}

TEST(Feed, WhatALineCannotKeepUp) {
    // 6.25 ms a message: two axes need 12.5 ms a segment, and with three in hand a little time to spare.
    const std::int64_t message = 50'000;
    EXPECT_EQ(feeding_problem(even(2, 200, 25), 200 * kMs, message, 20 * kMs), "");
    EXPECT_NE(feeding_problem(even(2, 200, 10), 200 * kMs, message, 0), "");
    EXPECT_NE(feeding_problem(even(2, 200, 25), 10 * kMs, message, 0), "") << "too short a lead-in";
    EXPECT_NE(feeding_problem(even(6, 200, 25), 500 * kMs, message, 0).find("6.2 ms"), std::string::npos);
}

}  // namespace
}  // namespace nplc::midi_client
