#include "sequencer/term.h"

#include <gtest/gtest.h>

#include <random>

namespace nplc::sequencer {
namespace {

// 001 §6.1.5: IF INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR; X = 0 in both bytes.
TEST(Term, ManualsConditionExample) {
    const TermBytes bytes{0xC0, 0x41, 0x49, 0x3E, 0x80, 0x00, 0x00, 0x00};
    const Condition c = decode(bytes).condition;
    EXPECT_EQ(c.input, 0b0100'0001);
    EXPECT_EQ(c.care, 0b100'1001);
    EXPECT_FALSE(c.needs_timer_zero);
    EXPECT_FALSE(c.needs_counter_zero);
}

TEST(Term, StateByteBits) {
    TermBytes bytes{0x05, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(decode(bytes).condition.step, 5);
    EXPECT_TRUE(decode(bytes).condition.needs_counter_zero);
    EXPECT_TRUE(decode(bytes).condition.needs_timer_zero);
    bytes[0] = 0x45;  // COUNTER_BIT
    EXPECT_FALSE(decode(bytes).condition.needs_counter_zero);
    EXPECT_TRUE(decode(bytes).condition.needs_timer_zero);
    bytes[0] = 0x85;  // TIMER_BIT
    EXPECT_TRUE(decode(bytes).condition.needs_counter_zero);
    EXPECT_FALSE(decode(bytes).condition.needs_timer_zero);
}

TEST(Term, FastStatementBits) {
    const FastStatement s = decode(TermBytes{0, 0, 0, 0x42, 0x5D, 0xCA, 0xF4, 0x01}).fast;
    EXPECT_EQ(s.next_step, 2);
    EXPECT_TRUE(s.presets_counter);
    EXPECT_TRUE(s.sends);
    EXPECT_EQ(s.command, 0x5D);
    EXPECT_EQ(s.outputs, 0x0A);
    EXPECT_TRUE(s.clears_counter);
    EXPECT_TRUE(s.counts_down);
    EXPECT_EQ(s.preset, 500);
}

TEST(Term, FlexStatementBits) {
    const Term term = decode(TermBytes{0, 0, 0x80, 0x83, 0x70, 0x82, 0x03, 0x00});
    EXPECT_TRUE(term.is_flex);
    EXPECT_EQ(term.flex.reg, 3);
    EXPECT_TRUE(term.flex.longword);
    EXPECT_EQ(term.flex.low_word, 0x8270);
    EXPECT_EQ(term.flex.high_word, 0x0003);
}

TEST(Term, EndIsStateBitsOnly) {
    EXPECT_TRUE(is_end(TermBytes{0x3F}));
    EXPECT_TRUE(is_end(TermBytes{0xFF}));
    EXPECT_FALSE(is_end(TermBytes{0x3E}));
}

TEST(Term, EveryEightBytesComeBackUnchanged) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 200'000; ++i) {
        std::uint64_t value = random();
        TermBytes bytes;
        for (auto& b : bytes) {
            b = static_cast<std::uint8_t>(value);
            value >>= 8;
        }
        ASSERT_EQ(encode(decode(bytes)), bytes) << "seed 1, round " << i;
    }
}

}  // namespace
}  // namespace nplc::sequencer
