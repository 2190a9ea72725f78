#include "sim/profile_blocks.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace nplc::sim {
namespace {

TEST(VelocityBlock, ChangesByTheAccelerationAtMost) {
    EXPECT_EQ(velocity_block(1600, 0, 160), 160);
    EXPECT_EQ(velocity_block(1600, 1500, 160), 1600);
    EXPECT_EQ(velocity_block(-1600, 100, 160), -60);
    EXPECT_EQ(velocity_block(0, 50, 0), 50);
}

// 3 + 2 + 1 = 6 with a = 1; 4 would need 4 + 3 + 2 + 1 = 10. With a = 10: 25 + 15 + 5 = 45, and 26 + 16 + 6
// = 48.
TEST(PositionBlock, FastestThatCanStop) {
    EXPECT_EQ(fastest_that_can_stop(0, 1), 0);
    EXPECT_EQ(fastest_that_can_stop(6, 1), 3);
    EXPECT_EQ(fastest_that_can_stop(9, 1), 3);
    EXPECT_EQ(fastest_that_can_stop(10, 1), 4);
    EXPECT_EQ(fastest_that_can_stop(45, 10), 25);
    EXPECT_EQ(fastest_that_can_stop(47, 10), 25);
    EXPECT_EQ(fastest_that_can_stop(48, 10), 26);
    EXPECT_EQ(fastest_that_can_stop(7, 100), 7);
    EXPECT_EQ(fastest_that_can_stop(100, 0), 0);
}

TEST(PositionBlock, StandsOnItsTarget) {
    EXPECT_EQ(position_block(0, 0, 1600, 160, 160), 0);
}

TEST(PositionBlock, BrakesWhenTheTargetIsBehind) {
    EXPECT_EQ(position_block(-1000, 500, 1600, 160, 160), 340);
    EXPECT_EQ(position_block(1000, -500, 1600, 160, 160), -340);
    EXPECT_EQ(position_block(0, 500, 1600, 160, 160), 340);
}

// From rest: ends exactly on the target, keeps both limits at each sample, passes the target never, stays
// there.
TEST(PositionBlock, RandomMovesEndExactlyWithinTheirLimits) {
    std::mt19937 random(2);
    for (int round = 0; round < 3000; ++round) {
        const auto limit = static_cast<std::int32_t>(random() % 4000 + 1);
        const auto acceleration = static_cast<std::int32_t>(random() % 1000 + 1);
        const std::int64_t target = static_cast<std::int64_t>(random() % 2'000'000) - 1'000'000;
        std::int64_t position = 0;
        std::int32_t v_old = 0;
        int samples = 0;
        while (position != target || v_old != 0) {
            const std::int32_t v =
                position_block(target - position, v_old, limit, acceleration, acceleration);
            ASSERT_LE(std::abs(v), limit) << "seed 2, round " << round;
            ASSERT_LE(std::abs(v - v_old), acceleration) << "seed 2, round " << round;
            position += v;
            v_old = v;
            ASSERT_LE(std::abs(position), std::abs(target)) << "seed 2, round " << round;
            ASSERT_LT(++samples, 2'100'000) << "seed 2, round " << round;
        }
        EXPECT_EQ(position_block(0, 0, limit, acceleration, acceleration), 0);
    }
}

// No profile with these limits is faster: distance 1600 x 10, limit 1600, a = 160: 10 samples up to 1600
// cover 160 (1 + ... + 10) = 8800, braking from 1600 covers 7200 in 9: together 16000 in 19 samples.
TEST(PositionBlock, TakesTheShortestTime) {
    std::int64_t position = 0;
    std::int32_t v = 0;
    int samples = 0;
    while (position != 16000) {
        v = position_block(16000 - position, v, 1600, 160, 160);
        position += v;
        ++samples;
    }
    EXPECT_EQ(samples, 19);
}

// The target changes at random times; after the last change the same end is reached.
TEST(PositionBlock, ChangedTargetsAndReversals) {
    std::mt19937 random(3);
    for (int round = 0; round < 500; ++round) {
        const auto limit = static_cast<std::int32_t>(random() % 3000 + 1);
        const auto acceleration = static_cast<std::int32_t>(random() % 500 + 1);
        std::int64_t position = 0;
        std::int64_t target = 0;
        std::int32_t v_old = 0;
        for (int sample = 0; sample < 3000; ++sample) {
            if (sample < 1000 && random() % 50 == 0) {
                target = static_cast<std::int64_t>(random() % 200'000) - 100'000;
            }
            const std::int32_t v =
                position_block(target - position, v_old, limit, acceleration, acceleration);
            ASSERT_LE(std::abs(v), limit) << "seed 3, round " << round;
            ASSERT_LE(std::abs(v - v_old), acceleration) << "seed 3, round " << round;
            position += v;
            v_old = v;
        }
        if (limit >= 150) {
            EXPECT_EQ(position, target) << "seed 3, round " << round;
        }
    }
}

}  // namespace
}  // namespace nplc::sim
