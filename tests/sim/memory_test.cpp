#include "sim/motor_memory.h"

#include <gtest/gtest.h>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

TEST(Memory, SmallMotorsKeepLongwordsInTwoNumbersLowFirst) {
    MotorMemory m(registers::Model::mac140);
    m.write(3, 0x00038270, true);  // 230000
    EXPECT_EQ(m.get(cell::P_SOLL), 230'000);
    EXPECT_EQ(m.read(3, false), 0x8270U);
    EXPECT_EQ(m.read(4, false), 0x0003U);
    m.write(3, 0xFFFF, false);  // low word only
    EXPECT_EQ(m.get(cell::P_SOLL), 0x0003FFFF);
    m.set(cell::P_SOLL, -5);
    EXPECT_EQ(m.get(cell::P_SOLL), -5);
    m.set(cell::V_SOLL, -1600);
    EXPECT_EQ(m.get(cell::V_SOLL), -1600);
    m.set(cell::A_SOLL, 65'000);
    EXPECT_EQ(m.get(cell::A_SOLL), 65'000);
    m.write(255, 0x12345678, true);
    EXPECT_EQ(m.read(255, false), 0x5678U);
    EXPECT_EQ(m.read(255, true), 0x12345678U);
}

// The program has each register by the sign and width that the manual's table gives it, whatever wrote it. R:
// but KVOUT and L1..L4, which are no less than 1, and AMPLITUDE.
TEST(Memory, WordsFromTheLineAreNumbersOfTheirRegister) {
    constexpr auto kModel = registers::Model::mac140;
    MotorMemory m(kModel);
    int looked_at = 0;
    for (int number = 1; number < 256; ++number) {
        const auto reg = static_cast<std::uint8_t>(number);
        const registers::Register* entry = registers::find(kModel, reg);
        const bool ours = number == KVOUT || (number >= L1 && number < L1 + 4) || number == 127;
        if (entry == nullptr || ours) continue;
        ++looked_at;
        const bool wide = registers::is_32_bit(entry->format);
        m.write(reg, 0xFFFF'FFFE, wide);
        const std::int32_t expected = wide || entry->min < 0 ? -2 : 0xFFFE;
        EXPECT_EQ(m.get(cell::word(reg, reg)), expected) << number;
        EXPECT_EQ(m.read(reg, wide), wide ? 0xFFFF'FFFE : 0xFFFE) << number;
    }
    EXPECT_GT(looked_at, 100);
}

// 001 §3.2.153 to §3.2.158, 004 "Diverse".
TEST(Memory, TheIdentityIsThereAndTellsTwoMotorsApart) {
    for (const auto model : {registers::Model::mac50, registers::Model::mac140, registers::Model::mac800}) {
        MacMotor one(model, {.address = 8}), other(model, {.address = 9});
        for (const char* name : {"PROG_VERSION", "MOTOR_TYPE", "SERIAL_NMB", "HW_VERSION", "CHKSUM"}) {
            const bool large = model == registers::Model::mac800;
            const std::string_view wanted = !large                                ? name
                                            : name == std::string("SERIAL_NMB")   ? "SERIAL_NUMBER"
                                            : name == std::string("PROG_VERSION") ? "PROG_VER"
                                                                                  : name;
            const registers::Register& reg = *registers::find(model, wanted);
            EXPECT_NE(one.read(reg.number), 0) << name;
            EXPECT_EQ(one.read(reg.number) != other.read(reg.number), name == std::string("SERIAL_NMB"))
                << name;
        }
    }
    MacMotor motor(registers::Model::mac140, {.address = 8});
    EXPECT_EQ(motor.read(153), 140);
    EXPECT_EQ(motor.read(154), 999'140'008);
}

TEST(Memory, LongwordIntoAWordRegisterReachesTheNext) {
    MotorBench b;
    b.motor.write(V_SOLL, 0x00640320, true);
    EXPECT_EQ(b.reg(V_SOLL), 0x0320);
    EXPECT_EQ(b.reg(A_SOLL), 0x0064);
}

TEST(Memory, Mac800KeepsALongwordInEach) {
    MotorMemory m(registers::Model::mac800);
    m.set(cell::V_SOLL, -70'000);
    EXPECT_EQ(m.get(cell::V_SOLL), -70'000);
    m.set(cell::A_SOLL, 360);
    EXPECT_EQ(m.get(cell::V_SOLL), -70'000);
    m.set(cell::FNC_OUT, 5);
    EXPECT_EQ(m.read(166, true), 5U);
    EXPECT_EQ(m.read(117, true), 0U);
}

// 001 §3.2.13, §3.2.89 to §3.2.111, §3.2.124 to §3.2.127, §3.2.140 to §3.2.142, §3.2.148 to §3.2.150.
TEST(Memory, TellsOnceThatARegisterOfTheRegulatorsWasWritten) {
    MotorMemory m(registers::Model::mac140);
    EXPECT_TRUE(m.take_settings_written());
    EXPECT_FALSE(m.take_settings_written());
    const auto tells = [&](int reg, bool longword) {
        m.write(static_cast<std::uint8_t>(reg), 1, longword);
        return m.take_settings_written();
    };
    for (const int reg : {13, 89, 101, 111, 124, 127, 140, 142, 148, 150})
        EXPECT_TRUE(tells(reg, false)) << reg;
    for (const int reg : {1, 12, 14, 88, 112, 123, 128, 139, 143, 147, 151}) {
        EXPECT_FALSE(tells(reg, false)) << reg;
    }
    for (const int reg : {88, 123, 139, 147}) EXPECT_TRUE(tells(reg, true)) << reg;
    m.set(cell::KIA[1], 256);
    EXPECT_TRUE(m.take_settings_written());
    m.set(cell::V_IST, 5);
    EXPECT_FALSE(m.take_settings_written());
}

// 004: KVOUT 13, filters 121 to 149, ELDEG_OFFSET, PHASE_COMP and AMPLITUDE 172 to 174, offsets and gains 186
// to 189.
TEST(Memory, TellsItOfMac800sNumbersToo) {
    MotorMemory m(registers::Model::mac800);
    EXPECT_TRUE(m.take_settings_written());
    for (const int reg : {13, 121, 149, 172, 174, 186, 189}) {
        m.write(static_cast<std::uint8_t>(reg), 1, true);
        EXPECT_TRUE(m.take_settings_written()) << reg;
    }
    for (const int reg : {101, 120, 150, 171, 175, 185, 190}) {
        m.write(static_cast<std::uint8_t>(reg), 1, false);
        EXPECT_FALSE(m.take_settings_written()) << reg;
    }
}

// 001 §3.2.118, §3.2.119; 004 167, 168: the registers have no fraction, and end at the end of their range.
TEST(Memory, CutsTheFiltersOutputsWhenALineReadsThem) {
    MotorMemory small(registers::Model::mac140);
    small.show_filters(-70.75, 1e6);
    EXPECT_EQ(small.read(118, false), 0x10000U - 70);
    EXPECT_EQ(small.read(119, false), 0x7FFFU);
    EXPECT_EQ(small.read(118, true), 0x7FFFU << 16 | (0x10000U - 70));
    small.write(119, 5, false);
    EXPECT_EQ(small.read(118, false), 0x10000U - 70);
    EXPECT_EQ(small.read(119, false), 5U);
    MotorMemory big(registers::Model::mac800);
    big.show_filters(-70.75, 1e6);
    EXPECT_EQ(big.read(167, true), 0xFFFF'FFFFU - 69);
    EXPECT_EQ(big.read(168, true), 1'000'000U);
}

TEST(Memory, ACopyMayHaveOtherSettings) {
    MotorMemory m(registers::Model::mac140);
    MotorMemory stored(registers::Model::mac140);
    m.take_settings_written();
    stored.take_settings_written();
    m = stored;
    EXPECT_TRUE(m.take_settings_written());
    MotorMemory copy = m;
    EXPECT_TRUE(copy.take_settings_written());
}

TEST(Memory, ModeRegReachedByALongwordOnItsNeighbour) {
    MotorBench b;
    b.motor.write(PROG_VERSION, 0x0002004E, true);
    EXPECT_EQ(b.reg(MODE_REG), 2);
    EXPECT_EQ(b.reg(PROG_VERSION), 78);
    b.motor.write(PROG_VERSION, 0x00000040, true);
    EXPECT_EQ(b.reg(MODE_REG), 11);
}

// 001 §3.2.43 - 48: the pointer copies and returns to 0.
TEST(Memory, RegisterModePointers) {
    MotorBench b;
    b.set(P1 + 4, 12'345);  // P3
    b.set(V1 + 2, 777);
    b.set(A1 + 2, 55);
    b.set(T1 + 2, 321);
    b.set(L1 + 2, 0x180);
    b.set(Z1 + 2, 9);
    for (int pointer = P_REG_P; pointer <= Z_REG_P; ++pointer) {
        b.set(pointer, 3);
        EXPECT_EQ(b.reg(pointer), 0) << pointer;
    }
    EXPECT_EQ(b.reg(P_SOLL), 12'345);
    EXPECT_EQ(b.reg(V_SOLL), 777);
    EXPECT_EQ(b.reg(A_SOLL), 55);
    EXPECT_EQ(b.reg(T_SOLL), 321);
    EXPECT_EQ(b.reg(KVOUT), 0x180);
    EXPECT_EQ(b.reg(INPOSWIN), 9);
    b.set(A_REG_P, 5);  // only four
    EXPECT_EQ(b.reg(A_REG_P), 5);
    EXPECT_EQ(b.reg(A_SOLL), 55);
}

TEST(Memory, RelativePointersByErrStatOrByCntrlBits) {
    MotorBench b;
    b.set(P1, 100);
    b.set(ERR_STAT, 1 << 9);
    b.set(P_REG_P, 1);
    b.set(P_REG_P, 1);
    EXPECT_EQ(b.reg(P_SOLL), 200);
    b.set(ERR_STAT, 1 << 9 | 1 << 10);  // P_FNC wins
    b.set(P_REG_P, 1);
    EXPECT_EQ(b.reg(P_SOLL), 200);
    EXPECT_EQ(b.reg(P_FNC), -1600);

    MotorBench c(registers::Model::mac800);
    c.set(P1, 100);
    c.command(0x75);
    EXPECT_EQ(c.reg(CNTRL_BITS) & 0x18, 0x08);
    EXPECT_EQ(c.reg(ERR_STAT), 0);
    c.command(0x00);  // INIT, P1
    c.command(0x00);
    EXPECT_EQ(c.reg(P_SOLL), 200);
    c.command(0x76);
    EXPECT_EQ(c.reg(CNTRL_BITS) & 0x18, 0x10);
    c.command(0x00);
    EXPECT_EQ(c.reg(P_FNC), -1600);
    c.command(0x74);
    EXPECT_EQ(c.reg(CNTRL_BITS) & 0x18, 0);
    c.command(0x00);
    EXPECT_EQ(c.reg(P_SOLL), 100);
}

TEST(Memory, DefaultsMoveOutOfTheBox) {
    for (const auto model : {registers::Model::mac50, registers::Model::mac95, registers::Model::mac140,
                             registers::Model::mac141, registers::Model::mac800}) {
        MotorBench b(model);
        for (int set = 0; set < 4; ++set) {
            b.set(P1 + 2 * set, 5000 * (set + 1));
            b.command(static_cast<std::uint8_t>(0x6C + set));
            b.set(MODE_REG, 2);
            b.until_in_position();
            b.settle();
            EXPECT_EQ(b.motor.p_ist(), 5000 * (set + 1));
            EXPECT_EQ(b.reg(FNCERR), 0);
        }
        for (int v = 4; v < 8; ++v) EXPECT_GT(b.reg(V1 + v), b.reg(V1 + v - 1));
    }
}

}  // namespace
}  // namespace nplc::sim
