// The meaning of single terms and commands, by 001 §5.2.1.4 and §6.1.5 - §6.1.8.
#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "table/commands.h"
#include "table/terms.h"

namespace nplc::table {
namespace {

using sequencer::TermBytes;

TEST(Commands, SelectByModeAndRegister) {
    const auto select = select_command(0x28);  // VELOCITY: mode 01, V 01, 000
    ASSERT_TRUE(select);
    EXPECT_EQ(select->mode, Mode::velocity);
    EXPECT_EQ(register_of(select->selection), 65);
    EXPECT_FALSE(select_command(0x65));
    EXPECT_EQ(register_of({Group::p, 8}), 63);
    EXPECT_EQ(register_of({Group::z, 4}), 88);
    for (std::uint8_t number = 1; number <= 127; ++number) {
        const auto selection = selection_of(number);
        if (selection) {
            EXPECT_EQ(register_of(*selection), number);
        }
    }
    EXPECT_FALSE(selection_of(50));
    EXPECT_FALSE(selection_of(89));
}

TEST(Commands, SetsAndRelativeMovesByNumber) {
    EXPECT_FALSE(set_used(0x6B));
    EXPECT_EQ(set_used(0x6C), 1);
    EXPECT_EQ(set_used(0x6F), 4);
    EXPECT_FALSE(set_used(0x70));
    EXPECT_EQ(use_set(3), 0x6E);
    const auto move = [](std::uint8_t command) {
        const auto found = relative_move(command);
        return found ? std::tuple(int{found->index}, found->from_p_soll) : std::tuple(0, false);
    };
    EXPECT_EQ(move(0x68), std::tuple(7, false));
    EXPECT_EQ(move(0x69), std::tuple(8, false));
    EXPECT_EQ(move(0x71), std::tuple(7, true));
    EXPECT_EQ(move(0x72), std::tuple(8, true));
    EXPECT_EQ(move(0x70), std::tuple(0, false));
    EXPECT_EQ(move(0x11), std::tuple(0, false));  // INIT with a register
}

TEST(Commands, NamesAreTheManuals) {
    EXPECT_EQ(describe_command(0x65), "STOP");
    EXPECT_EQ(describe_command(0x6D), "USE_SET(2)");
    EXPECT_EQ(describe_command(0x77), "NOP (number 16#17)");
    EXPECT_TRUE(has_name(0x76));
    EXPECT_FALSE(has_name(0x77));
    EXPECT_FALSE(has_name(0x7C));
    EXPECT_TRUE(has_name(0x7D));
    EXPECT_TRUE(named_command(0x7F)->is_of_link);
    EXPECT_FALSE(named_command(0x60)->is_of_link);
    EXPECT_EQ(command_numbered(0x03), 0x63);
}

// STATE 02: COUNTER_BIT and TIMER_BIT are 0; INPUT 41h, CARE 49h.
TEST(Terms, WhatIsCompared) {
    std::vector<std::pair<unsigned, bool>> compared;
    for (const Compared& one : compared_by(TermBytes{0x02, 0x41, 0x49, 0x3E, 0x80, 0, 0, 0}))
        compared.emplace_back(one.key_bit, one.level);
    EXPECT_EQ(compared, (std::vector<std::pair<unsigned, bool>>{
                            {0, true}, {3, false}, {6, true}, {8, true}, {9, true}, {7, false}}));
}

TEST(Terms, TheValueAndItsPlace) {
    TermBytes timer{0xC1, 0, 0, 0x02, 0x80, 0, 0xF4, 0x01};
    EXPECT_EQ(value_place(timer), ValuePlace{});
    EXPECT_EQ(value_of(timer), 500U);
    set_value(timer, 0x0203);
    EXPECT_EQ(timer, (TermBytes{0xC1, 0, 0, 0x02, 0x80, 0, 0x03, 0x02}));
    EXPECT_EQ(value_place(TermBytes{0xC1, 0, 0, 0x42, 0x80, 0, 5, 0}), ValuePlace{ValuePlace::Kind::counter});
    TermBytes word{0xC1, 0, 0x80, 0x05, 0x34, 0x12, 0, 0};
    EXPECT_EQ(value_place(word), (ValuePlace{ValuePlace::Kind::reg, 5}));
    EXPECT_EQ(value_of(word), 0x1234U);
    set_value(word, 0xABCD5678);
    EXPECT_EQ(word, (TermBytes{0xC1, 0, 0x80, 0x05, 0x78, 0x56, 0, 0}));
    TermBytes longword{0xC1, 0, 0x80, 0x83, 0, 0, 0, 0};
    set_value(longword, 0xABCD5678);
    EXPECT_EQ(value_of(longword), 0xABCD5678U);
}

TEST(Terms, WhatNoProgramMakes) {
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0x01, 0x01, 0x3E, 0x80, 0, 0, 0}), Oddity::none);
    EXPECT_EQ(oddity_of(TermBytes{0xFE, 0, 0, 0x3E, 0x80, 0, 0, 0}), Oddity::of_step_62);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0x03, 0x01, 0x3E, 0x80, 0, 0, 0}), Oddity::level_without_care);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0x80, 0x00, 0x3E, 0x80, 0, 0, 0}), Oddity::none);  // ERROR
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0, 0x3F, 0x80, 0, 0, 0}), Oddity::next_is_63);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0, 0xBE, 0x80, 0, 0, 0}), Oddity::unused_bits);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0, 0x3E, 0x80, 0x10, 0, 0}), Oddity::unused_bits);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0, 0x3E, 0xE5, 0, 0, 0}), Oddity::command_not_sent);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0, 0x7E, 0x80, 0, 0, 0}), Oddity::counter_preset_of_0);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0x80, 0x80, 0, 0, 0, 0}), Oddity::register_0);
    EXPECT_EQ(oddity_of(TermBytes{0xC1, 0, 0x80, 0x05, 0, 0, 1, 0}), Oddity::upper_word_not_sent);
    EXPECT_EQ(fault_of(TermBytes{0xC1, 0, 0, 0x7F, 0x80, 0, 0, 0}), TermFault::next_is_63);
    EXPECT_EQ(fault_of(TermBytes{0xC1, 0, 0x80, 0x00, 0, 0, 0, 0}), TermFault::register_0);
    EXPECT_EQ(fault_of(TermBytes{0xC1, 0, 0x80, 0x3F, 0, 0, 0, 0}), TermFault::none);
}

}  // namespace
}  // namespace nplc::table
