// What FastMAC's commands and register pointers do to the registers that are kept for a MIDI drive (001
// §5.2.1.4, §4.4).

#include "motor/midi_registers.h"

#include <gtest/gtest.h>

namespace nplc::motor {
namespace {

using namespace registers;

struct MidiRegistersTest : testing::Test {
    MidiRegisters kept;

    void SetUp() override {
        for (unsigned i = 0; i < 8; ++i) {
            kept.set_position(P1 + 2 * i, -100'000 * static_cast<std::int32_t>(i + 1));
            kept.set_word(V1 + i, static_cast<std::uint16_t>(200 + i));
        }
        for (unsigned i = 0; i < 4; ++i) {
            kept.set_word(A1 + i, static_cast<std::uint16_t>(300 + i));
            kept.set_word(T1 + i, static_cast<std::uint16_t>(400 + i));
            kept.set_word(Z1 + i, static_cast<std::uint16_t>(500 + i));
        }
    }
};

TEST_F(MidiRegistersTest, CommandsThatSetZero) {
    kept.set_position(P_SOLL, 70'000);
    kept.set_word(V_SOLL, 8);
    kept.set_word(T_SOLL, 9);
    kept.execute(0x02);  // P_SOLL = 0
    EXPECT_EQ(kept.position(P_SOLL), 0);
    kept.execute(0x05);  // V_SOLL = 0
    EXPECT_EQ(kept.v_soll(), 0);
    EXPECT_EQ(kept.word(T_SOLL), 9);
    kept.execute(0x06);  // T_SOLL = 0
    EXPECT_EQ(kept.word(T_SOLL), 0);
    EXPECT_TRUE(kept.is_set(V_SOLL) && kept.is_set(T_SOLL)) << "0 is a value too";
}

TEST_F(MidiRegistersTest, ASelectedSetIsOneOfEachGroup) {
    for (unsigned i = 0; i < 4; ++i) {
        kept.execute(static_cast<std::uint8_t>(0x0C + i));
        EXPECT_EQ(kept.position(P_SOLL), -100'000 * static_cast<std::int32_t>(i + 1));
        EXPECT_EQ(kept.v_soll(), static_cast<std::int32_t>(200 + i));
        EXPECT_EQ(kept.word(A_SOLL), 300 + i);
        EXPECT_EQ(kept.word(T_SOLL), 400 + i);
        EXPECT_EQ(kept.word(INPOSWIN), 500 + i);
    }
}

TEST_F(MidiRegistersTest, EachSelectionByFastMacAndByItsPointer) {
    const struct {
        unsigned first, count, pointer, chosen;
    } groups[]{{0x08, 8, V_REG_P, V_SOLL},
               {0x10, 4, A_REG_P, A_SOLL},
               {0x14, 4, T_REG_P, T_SOLL},
               {0x1C, 4, Z_REG_P, INPOSWIN}};
    for (const auto& group : groups) {
        for (unsigned i = 0; i < group.count; ++i) {
            kept.select(group.first + i);
            const std::uint16_t chosen = kept.word(group.chosen);
            kept.set_word(group.chosen, 0);
            kept.write(group.pointer, static_cast<std::uint16_t>(i + 1));
            EXPECT_EQ(kept.word(group.chosen), chosen) << group.pointer << ' ' << i;
            EXPECT_EQ(chosen % 100, i) << "the values count from n00 on";
        }
        for (const std::uint16_t none : {std::uint16_t{0}, static_cast<std::uint16_t>(group.count + 1)}) {
            kept.set_word(group.chosen, 77);
            kept.write(group.pointer, none);
            EXPECT_EQ(kept.word(group.chosen), 77) << "out of range it selects nothing";
        }
    }
}

TEST_F(MidiRegistersTest, PositionsAbsoluteRelativeAndFromWhereItStands) {
    kept.write(P_REG_P, 3);
    EXPECT_EQ(kept.position(P_SOLL), -300'000);
    kept.execute(0x15);  // RELPOSPSOLL
    EXPECT_TRUE(kept.is_relative());
    kept.select(1);
    EXPECT_EQ(kept.position(P_SOLL), -500'000);
    kept.execute(0x14);
    EXPECT_FALSE(kept.is_relative());
    kept.select(1);
    EXPECT_EQ(kept.position(P_SOLL), -200'000);
    kept.execute(0x11);  // P_SOLL becomes the position plus P7
    EXPECT_TRUE(kept.awaits_position());
    kept.on_position(1'000'000);
    EXPECT_EQ(kept.position(P_SOLL), 300'000);
    kept.execute(0x12);  // plus P8
    kept.drop_awaited();
    kept.on_position(0);
    EXPECT_EQ(kept.position(P_SOLL), 300'000) << "what was dropped changes nothing";
}

TEST_F(MidiRegistersTest, WhatConcernsJvlsLineAndTheLoadDoesNothing) {
    const MidiRegisters before = kept;
    for (const unsigned number : {0x00U, 0x07U, 0x17U, 0x1CU})
        kept.execute(static_cast<std::uint8_t>(number));
    kept.select(0x18);  // L1
    kept.write(L_REG_P, 1);
    kept.set_word(P_IST, 5);
    for (const unsigned number : {P_SOLL, V_SOLL, A_SOLL, T_SOLL, INPOSWIN})
        EXPECT_EQ(kept.word(number), before.word(number)) << number;
    EXPECT_EQ(kept.word(P_IST), 0) << "not one that is kept";
}

TEST(MidiRegisters, WhatWasNeverWrittenIsUnsetAndSelectsNothing) {
    MidiRegisters kept;
    for (const unsigned number : {V_SOLL, A_SOLL, T_SOLL, INPOSWIN, V1, Z1})
        EXPECT_FALSE(kept.is_set(number)) << number;
    kept.select(0x08);
    EXPECT_FALSE(kept.is_set(V_SOLL));
    kept.set_word(V1, 0);
    kept.select(0x08);
    EXPECT_TRUE(kept.is_set(V_SOLL));
    kept.unset(V_SOLL);
    kept.unset(P_IST);
    EXPECT_FALSE(kept.is_set(V_SOLL));
    EXPECT_FALSE(kept.is_set(P_IST));
}

}  // namespace
}  // namespace nplc::motor
