#include "sim/midi_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace nplc::sim {
namespace {

/// What each increment takes, in ticks.
std::vector<std::int64_t> run_out(MidiProfile& profile, std::size_t most = 1'000'000) {
    std::vector<std::int64_t> intervals;
    while (profile.running() && intervals.size() < most) {
        intervals.push_back(profile.interval());
        profile.advance();
    }
    return intervals;
}

std::int64_t sum(const std::vector<std::int64_t>& intervals) {
    std::int64_t ticks = 0;
    for (const std::int64_t interval : intervals) ticks += interval;
    return ticks;
}

// 003 §IV: 16 speeds in equal steps; 000 §VI 0Fh: the ramp has 120 x AA increments. With a period of 720720,
// which 1..16 divide (lcm), step k has 16 x 720720 / k; a period has 16 bits, so 5040 and those of 1..10, 12,
// 14, 15, 16.
TEST(MidiProfile, ARampHasSixteenSpeeds) {
    constexpr std::uint16_t kPeriod = 5040;
    constexpr int kRamp = 3;
    MidiProfile profile;
    profile.begin_move(1'000, kPeriod, kRamp);
    const auto intervals = run_out(profile);
    ASSERT_EQ(intervals.size(), 1'000u);
    std::size_t at = 0;
    for (int step = 1; step <= 15; ++step) {
        for (int i = 0; i < kRamp * step; ++i, ++at) {
            const std::int64_t exact = 16 * kPeriod / step;
            EXPECT_GE(intervals[at], exact) << at;
            EXPECT_LE(intervals[at], exact + 1) << at;
            const std::int64_t mirrored = intervals[intervals.size() - 1 - at];
            EXPECT_NEAR(static_cast<double>(mirrored), static_cast<double>(exact), 1) << at;
        }
    }
    EXPECT_EQ(at, 120u * kRamp);
    for (; at < 1'000 - 120 * kRamp; ++at) EXPECT_EQ(intervals[at], kPeriod);
}

// Each step lasts 16 x AA periods (k AA increments of 16/k periods): a ramp takes 240 x AA periods, where the
// same way at full speed takes 120 x AA.
TEST(MidiProfile, TheTimeOfAMoveIsTheArithmetics) {
    for (const auto& [distance, period, ramp] :
         {std::tuple{10'000, 480, 16}, std::tuple{100'000, 48, 255}, std::tuple{241, 65'535, 1}}) {
        MidiProfile profile;
        profile.begin_move(distance, static_cast<std::uint16_t>(period), static_cast<std::uint8_t>(ramp));
        const std::int64_t ticks = sum(run_out(profile));
        const std::int64_t exact = std::int64_t{period} * (2 * 240 * ramp + distance - 2 * 120 * ramp);
        EXPECT_LE(std::abs(ticks - exact), 30) << distance;
    }
}

TEST(MidiProfile, AShortMoveTurnsBackBeforeFullSpeed) {
    MidiProfile profile;
    profile.begin_move(20, 100, 2);  // 2 + 4 + 4 increments of steps 1, 2, 3, and back
    const auto intervals = run_out(profile);
    ASSERT_EQ(intervals.size(), 20u);
    EXPECT_EQ(intervals.front(), 1'600);
    EXPECT_EQ(intervals.back(), 1'600);
    EXPECT_NEAR(static_cast<double>(intervals[9]), 1'600.0 / 3, 1);
    auto backwards = intervals;
    std::reverse(backwards.begin(), backwards.end());
    for (std::size_t i = 0; i < intervals.size(); ++i)
        EXPECT_LE(std::abs(intervals[i] - backwards[i]), 1) << i;
}

// 003 §IV: 0 bounds nothing.
TEST(MidiProfile, RampZeroIsAtFullSpeedAtOnce) {
    MidiProfile profile;
    profile.begin_move(5, 100, 0);
    EXPECT_EQ(run_out(profile), (std::vector<std::int64_t>(5, 100)));
    profile.begin_run(100, 0);
    EXPECT_EQ(profile.interval(), 100);
    profile.advance();
    profile.stop();
    EXPECT_FALSE(profile.running());
}

TEST(MidiProfile, ARunKeepsItsSpeedAndStopsOverAWholeRamp) {
    MidiProfile profile;
    profile.begin_run(160, 2);
    EXPECT_EQ(run_out(profile, 240).front(), 16 * 160);
    EXPECT_EQ(run_out(profile, 1'000), (std::vector<std::int64_t>(1'000, 160)));
    profile.stop();
    const auto down = run_out(profile);
    EXPECT_EQ(down.size(), 240u);
    EXPECT_EQ(down.back(), 16 * 160);
}

// Half the period, twice the speed: speeds 17/16, 18/16 ... 32/16 of the old one.
TEST(MidiProfile, ARunChangesItsSpeedOverARamp) {
    MidiProfile profile;
    profile.begin_run(1'600, 1);
    run_out(profile, 500);
    profile.begin_run(800, 1);
    const auto up = run_out(profile, 130);
    EXPECT_NEAR(static_cast<double>(up.front()), 1'600 * 16.0 / 17, 1);
    EXPECT_NEAR(static_cast<double>(up[119]), 1'600 * 16.0 / 31, 1);
    EXPECT_EQ(up[120], 800);
    EXPECT_TRUE(std::is_sorted(up.rbegin(), up.rend(), [](auto a, auto b) { return a + 1 < b; }));
    profile.begin_run(1'600, 1);
    const auto down = run_out(profile, 130);
    EXPECT_NEAR(static_cast<double>(down.front()), 1'600 * 16.0 / 31, 1);
    EXPECT_EQ(down[120], 1'600);
}

// Wherever a move is stopped it needs the increments that its speed took to reach.
TEST(MidiProfile, AStoppedMoveEndsAsSoonAsItsRampAllows) {
    constexpr std::uint8_t kRamp = 4;
    const std::map<int, int> way_by_made{{0, 0},     {1, 4},     {4, 12},   {12, 24},
                                         {100, 112}, {480, 480}, {600, 480}};
    for (const auto& [made, way] : way_by_made) {
        MidiProfile profile;
        profile.begin_move(2'000, 100, kRamp);
        run_out(profile, static_cast<std::size_t>(made));
        profile.stop();
        EXPECT_EQ(run_out(profile).size(), static_cast<std::size_t>(way)) << made;
    }
    // Near the end there is less to go than that.
    MidiProfile profile;
    profile.begin_move(2'000, 100, kRamp);
    run_out(profile, 1'990);
    profile.stop();
    EXPECT_EQ(profile.remaining(), 10);
}

TEST(MidiProfile, EveryMoveHasItsIncrementsAndNeverJumpsInSpeed) {
    constexpr unsigned kSeed = 9;
    std::mt19937 random(kSeed);
    for (int i = 0; i < 300; ++i) {
        const auto distance = static_cast<std::int64_t>(1 + random() % 5'000);
        const auto period = static_cast<std::uint16_t>(16 + random() % 60'000);
        const auto ramp = static_cast<std::uint8_t>(1 + random() % 20);
        MidiProfile profile;
        profile.begin_move(distance, period, ramp);
        const auto intervals = run_out(profile);
        ASSERT_EQ(intervals.size(), static_cast<std::size_t>(distance))
            << "seed " << kSeed << ", round " << i;
        ASSERT_GE(*std::min_element(intervals.begin(), intervals.end()), period);
        for (std::size_t j = 1; j < intervals.size(); ++j) {
            // One step up or down at the most: k to k + 1.
            const double before = 16.0 * period / static_cast<double>(intervals[j - 1]);
            const double after = 16.0 * period / static_cast<double>(intervals[j]);
            ASSERT_LE(std::abs(before - after), 1.7) << "seed " << kSeed << ", round " << i << " at " << j;
        }
    }
}

}  // namespace
}  // namespace nplc::sim
