#include "sequencer/explain.h"

#include <gtest/gtest.h>

namespace nplc::sequencer {
namespace {

// Step 5, timer and counter must be 0, INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR.
constexpr TermBytes kStrict{0x05, 0x41, 0x49, 0x3E, 0x80, 0, 0, 0};

TEST(Explain, ATermThatFires) {
    const Verdict verdict = explain(kStrict, {.step = 5}, 0x41);
    EXPECT_TRUE(verdict.fires());
    EXPECT_EQ(verdict, Verdict{});
}

TEST(Explain, AnotherStep) {
    EXPECT_EQ(explain(kStrict, {.step = 4}, 0x41), Verdict{.other_step = true});
}

TEST(Explain, TimerRunning) {
    EXPECT_EQ(explain(kStrict, {.step = 5, .timer = 1}, 0x41), Verdict{.timer_running = true});
}

TEST(Explain, CounterNotZero) {
    EXPECT_EQ(explain(kStrict, {.step = 5, .counter = 1}, 0x41), Verdict{.counter_not_zero = true});
}

TEST(Explain, TimerAndCounterBitsSetDoNotMatter) {
    TermBytes term = kStrict;
    term[0] = 0xC5;
    EXPECT_TRUE(explain(term, {.step = 5, .timer = 1, .counter = 1}, 0x41).fires());
}

TEST(Explain, EachDifferingBitIsNamed) {
    EXPECT_EQ(explain(kStrict, {.step = 5}, 0x40).differing, 0x01);
    EXPECT_EQ(explain(kStrict, {.step = 5}, 0x49).differing, 0x08);
    EXPECT_EQ(explain(kStrict, {.step = 5}, 0x01).differing, 0x40);
    EXPECT_EQ(explain(kStrict, {.step = 5}, 0xC1).differing, 0x80);
    EXPECT_EQ(explain(kStrict, {.step = 5}, 0x88).differing, 0xC9);
}

TEST(Explain, BitsNobodyCaresForDoNotDiffer) {
    EXPECT_TRUE(explain(kStrict, {.step = 5}, 0x77).fires());
}

TEST(Explain, ErrorDiffersWhateverCareSays) {
    constexpr TermBytes kFlexWithoutCare{0xC0, 0x00, 0x80, 0x05, 0, 0, 0, 0};
    EXPECT_EQ(explain(kFlexWithoutCare, {}, 0xFF).differing, 0x80);
}

TEST(Explain, AllReasonsAtOnce) {
    const Verdict verdict = explain(kStrict, {.step = 6, .timer = 9, .counter = 9}, 0x00);
    EXPECT_EQ(verdict, (Verdict{true, true, true, 0x41}));
}

}  // namespace
}  // namespace nplc::sequencer
