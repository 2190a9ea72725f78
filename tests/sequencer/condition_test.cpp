#include <gtest/gtest.h>

#include "sequencer/state.h"

namespace nplc::sequencer {
namespace {

// Timer and counter must be 0, INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR.
constexpr TermBytes kStrict{0x05, 0x41, 0x49, 0x3E, 0x80, 0, 0, 0};

bool is_true_in(TermView term, const State& state, InputImage image) {
    return is_true(term, key_of(image, state));
}

TEST(Condition, ATermThatIsTrue) {
    EXPECT_EQ(step_of(kStrict), 5);
    EXPECT_TRUE(is_true_in(kStrict, {.step = 5}, 0x41));
}

TEST(Condition, TimerAndCounterMustBeZero) {
    EXPECT_FALSE(is_true_in(kStrict, {.step = 5, .timer = 1}, 0x41));
    EXPECT_FALSE(is_true_in(kStrict, {.step = 5, .counter = 1}, 0x41));
    EXPECT_FALSE(is_true_in(kStrict, {.step = 5, .timer = 9, .counter = 9}, 0x41));
}

TEST(Condition, TimerAndCounterBitsSetDoNotMatter) {
    TermBytes term = kStrict;
    term[0] = 0xC5;
    EXPECT_TRUE(is_true_in(term, {.step = 5, .timer = 1, .counter = 1}, 0x41));
}

TEST(Condition, EachDifferingBitCounts) {
    for (const unsigned image : {0x40U, 0x49U, 0x01U, 0xC1U, 0x88U, 0x00U})
        EXPECT_FALSE(is_true_in(kStrict, {.step = 5}, static_cast<InputImage>(image))) << image;
}

TEST(Condition, BitsThatCareLeavesOutDoNotCount) {
    EXPECT_TRUE(is_true_in(kStrict, {.step = 5}, 0x77));
}

TEST(Condition, ErrorCountsWhateverCareSays) {
    constexpr TermBytes kFlexWithoutCare{0xC0, 0x00, 0x80, 0x05, 0, 0, 0, 0};
    EXPECT_FALSE(is_true_in(kFlexWithoutCare, {}, 0xFF));
    EXPECT_TRUE(is_true_in(kFlexWithoutCare, {}, 0x7F));
}

}  // namespace
}  // namespace nplc::sequencer
