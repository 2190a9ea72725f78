#include "midi_client/plan.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace nplc::midi_client {
namespace {

constexpr std::int64_t kPlanMs = 8'000;  // ticks of 0.125 us

/// Whether a segment ends within `late` of that time, so many increments from the start.
bool passes(const AxisPlan& axis, std::int64_t ticks, std::int64_t late, std::int64_t way) {
    std::int64_t time = 0;
    std::int64_t position = 0;
    for (const Segment& one : axis.segments) {
        time += one.ticks();
        position += one.pause ? 0 : one.steps;
        if (std::abs(time - ticks) <= late && position == way) return true;
    }
    return false;
}

TEST(Plan, TheManualsExample) {
    // 000 §VI 1Eh: 03E8h steps at 1000h, and a pause that takes as long.
    EXPECT_EQ(segment_data({.steps = 1000, .period = 0x1000}), 0x03E81000u);
    EXPECT_EQ(segment_data({.steps = -1, .period = 0xFFFF}), 0xFFFFFFFFu);
    const auto [plan, error] = plan_path({0, 1}, {{0, {0, 0}}, {1000 * 0x1000, {1000, 0}}});
    ASSERT_EQ(error, "");
    EXPECT_EQ(plan.axes[0].segments, (std::vector<Segment>{{false, 1000, 0x1000}}));
    ASSERT_EQ(plan.axes[1].segments.size(), 1u);
    EXPECT_TRUE(plan.axes[1].segments[0].pause);
    EXPECT_LE(std::abs(plan.axes[1].ticks() - 1000 * 0x1000), 32);
}

TEST(Plan, RoundingOfPeriodsDoesNotAddUp) {
    // 7 steps in 1 ms are 1142.857 ticks each: 1143 for most, and 1142 as often as it takes.
    std::vector<Waypoint> path;
    for (std::int64_t i = 0; i <= 1000; ++i) path.push_back({i * kPlanMs, {7 * i}});
    const auto [plan, error] = plan_path({3}, path);
    ASSERT_EQ(error, "");
    EXPECT_EQ(plan.axes[0].displacement(), 7000);
    EXPECT_LE(std::abs(plan.axes[0].ticks() - 1000 * kPlanMs), 3);
    for (const Segment& one : plan.axes[0].segments) EXPECT_TRUE(one.period == 1143 || one.period == 1142);
}

TEST(Plan, TooSlowForASegmentStandsAndSteps) {
    // 5 steps in 100 ms: a segment is never slower than 65535 ticks a step, here 327675 of 800000.
    const auto [plan, error] = plan_path({0}, {{0, {0}}, {100 * kPlanMs, {5}}, {200 * kPlanMs, {205}}});
    ASSERT_EQ(error, "");
    const auto& segments = plan.axes[0].segments;
    ASSERT_EQ(segments.size(), 3u);
    EXPECT_TRUE(segments[0].pause) << "it is faster later, so it stands first";
    EXPECT_EQ(segments[1].steps, 5);
    EXPECT_GE(segments[1].period, 65'534);
    EXPECT_TRUE(passes(plan.axes[0], 100 * kPlanMs, 3, 5));
    EXPECT_EQ(plan.axes[0].displacement(), 205);
}

TEST(Plan, ManyStepsAreSeveralSegments) {
    const auto [plan, error] = plan_path({0}, {{0, {0}}, {10'000 * kPlanMs, {-100'000}}});
    ASSERT_EQ(error, "");
    EXPECT_EQ(plan.axes[0].segments, (std::vector<Segment>(4, {false, -25'000, 800})));
}

TEST(Plan, LongPausesAreSeveralSegments) {
    // 1000 s: one segment holds 32767 x 65535 ticks, 268 s.
    const auto [plan, error] = plan_path({0}, {{0, {0}}, {1'000'000 * kPlanMs, {0}}});
    ASSERT_EQ(error, "");
    EXPECT_EQ(plan.axes[0].segments.size(), 4u);
    EXPECT_LE(std::abs(plan.axes[0].ticks() - 1'000'000 * kPlanMs), 32'768);
}

/// Half a tick a step of the segment before each corner, and the increments exactly.
TEST(Plan, RandomPathsMeetTheirCornersInTimeAndPlace) {
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const auto any = [&](std::int64_t from, std::int64_t to) {
            return std::uniform_int_distribution<std::int64_t>(from, to)(random);
        };
        std::vector<Waypoint> path{{0, {any(-9, 9), any(-9, 9), 0}}};
        for (int i = 0; i < 50; ++i) {
            Waypoint next = path.back();
            next.ticks += any(20 * kPlanMs, 300 * kPlanMs);
            for (auto& one : next.positions) one += any(0, 3) == 0 ? any(-15, 15) : any(-2000, 2000);
            path.push_back(next);
        }
        const auto [plan, error] = plan_path({1, 2, 3}, path);
        ASSERT_EQ(error, "");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 1; i < path.size(); ++i) {
                const std::int64_t steps = std::abs(path[i].positions[axis] - path[i - 1].positions[axis]);
                // Pauses round to 37 steps of 65535 ticks in 300 ms at the most.
                const std::int64_t late = std::max<std::int64_t>(steps, 38) / 2 + 1;
                const std::int64_t way = path[i].positions[axis] - path[0].positions[axis];
                ASSERT_TRUE(passes(plan.axes[axis], path[i].ticks, late, way)) << "corner " << i;
            }
        }
    }
}

TEST(Plan, WhatCannotBe) {
    EXPECT_NE(plan_path({}, {{0, {}}, {1, {}}}).error, "");
    EXPECT_NE(plan_path({0}, {{0, {0}}}).error, "");
    EXPECT_NE(plan_path({0}, {{5, {0}}, {9, {0}}}).error, "");
    EXPECT_NE(plan_path({0, 1}, {{0, {0, 0}}, {9, {0}}}).error, "");
    EXPECT_EQ(plan_path({0}, {{0, {0}}, {9, {1}}, {9, {2}}}).error,
              "point 3: its time is not later than the one before");
    EXPECT_EQ(plan_path({4}, {{0, {0}}, {kPlanMs, {8'001}}}).error, "")
        << "within rounding of one tick a step";
    EXPECT_EQ(plan_path({4}, {{0, {0}}, {kPlanMs, {20'000}}}).error,
              "point 2: axis 4 would have to be faster than a segment can say (8000000 increments a second)");
}

TEST(CirclePath, ClosesExactlyAndHasItsSpeed) {
    const Circle circle{.radius = 10'000, .centre_x = -10'000, .centre_y = 3, .speed = 20'000, .turns = 2};
    const auto path = circle_path(circle);
    ASSERT_FALSE(path.empty());
    EXPECT_EQ(path.front().positions, (std::vector<std::int64_t>{0, 3}));
    EXPECT_EQ(path.back().positions, path.front().positions);
    // 2 x 2 pi x 10000 / 20000 s, in ticks.
    EXPECT_NEAR(static_cast<double>(path.back().ticks), 6.283185307 * 8e6, 1);
    // 31 corners a turn: the arc stands 10000 x (1 - cos(pi / 31)) = 51.3 increments above the chord, and
    // corners are rounded to half an increment.
    EXPECT_EQ(path.size(), 63u);
    EXPECT_NEAR(circle_deviation(circle, path), 51.3, 1.0);
}

TEST(CirclePath, SpeedsUpAndSlowsDown) {
    const Circle circle{.radius = 10'000, .speed = 20'000, .acceleration = 40'000, .clockwise = true};
    const auto path = circle_path(circle);
    // v / a longer than without: half a second.
    EXPECT_NEAR(static_cast<double>(path.back().ticks) / 8e6, 3.14159265 + 0.5, 1e-6);
    EXPECT_GT(path[1].ticks, path[16].ticks - path[15].ticks);
    EXPECT_LT(path[1].positions[1], 0) << "clockwise";
    EXPECT_EQ(circle_path({.radius = 0, .speed = 1}).size(), 0u);
    EXPECT_EQ(circle_path({.radius = 1, .speed = 0}).size(), 0u);
}

}  // namespace
}  // namespace nplc::midi_client
