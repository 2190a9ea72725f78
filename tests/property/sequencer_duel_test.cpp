// Engine and is_true() against the naive sequencer. The build gives the number of tables, so
// that the same file makes the quick and the full tier.
#include <gtest/gtest.h>

#include "duel.h"

namespace nplc::property {
namespace {

constexpr int kScans = 24;

Seen play(Shape shape, std::uint64_t tables) {
    Seen seen;
    const std::uint64_t first = (static_cast<std::uint64_t>(shape) + 1) * 1'000'000'000;
    for (std::uint64_t i = 0; i < tables * NPLC_DUEL_FACTOR; ++i) {
        const std::string difference = duel(shape, first + i, kScans, seen);
        if (difference.empty()) continue;
        ADD_FAILURE() << difference;
        break;
    }
    return seen;
}

TEST(SequencerDuel, Uniform) {
    const Seen seen = play(Shape::uniform, 4000);
    EXPECT_GT(seen.fired, 100U);
    EXPECT_GT(seen.idle_repeats, 1000U);
}

TEST(SequencerDuel, Dense) {
    const Seen seen = play(Shape::dense, 6000);
    EXPECT_GT(seen.fired, seen.scans / 4);
    EXPECT_GT(seen.several_true, seen.scans / 10);
    EXPECT_GT(seen.orders, seen.scans / 10);
}

TEST(SequencerDuel, Scattered) {
    const Seen seen = play(Shape::scattered, 2000);
    EXPECT_GT(seen.fired, seen.scans / 8);
}

TEST(SequencerDuel, ManyTrue) {
    const Seen seen = play(Shape::many_true, 2500);
    EXPECT_GT(seen.several_true, seen.scans / 4);
}

TEST(SequencerDuel, ArbitraryBytes) {
    const Seen seen = play(Shape::arbitrary, 6000);
    EXPECT_GT(seen.refused, 1000U);
    EXPECT_GT(seen.scans, 1000U);
}

}  // namespace
}  // namespace nplc::property
