#include "sim/motor_inputs.h"

#include <gtest/gtest.h>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

// 001 §3.2.122: 10 V are 1023, so 5 V are 511.5; 004: VDC = ANINP x 0.0048828, 10 V are 2048.
TEST(Terminals, VoltsBecomeTheRegistersUnit) {
    EXPECT_EQ(analogue_register(registers::Model::mac140, 10'000), 1023);
    EXPECT_EQ(analogue_register(registers::Model::mac140, 5'000), 511);
    EXPECT_EQ(analogue_register(registers::Model::mac140, -10'000), -1023);
    EXPECT_EQ(analogue_register(registers::Model::mac140, 24'000), 1023);
    EXPECT_EQ(analogue_register(registers::Model::mac800, 10'000), 2048);
}

// 5.4 V are 552.4 of 1023 and 1105.9 of 2048; 4.4 V are 450.1 and 901.1.
TEST(Terminals, TheLogicLevelHasItsHysteresis) {
    AnalogueLevel level(registers::Model::mac140);
    EXPECT_FALSE(level.on());
    EXPECT_FALSE(level.update(552));
    EXPECT_TRUE(level.update(553));
    EXPECT_TRUE(level.update(451));
    EXPECT_FALSE(level.update(450));
    EXPECT_FALSE(level.update(552));
    AnalogueLevel big(registers::Model::mac800);
    EXPECT_FALSE(big.update(1105));
    EXPECT_TRUE(big.update(1106));
    EXPECT_TRUE(big.update(902));
    EXPECT_FALSE(big.update(901));
}

// 001 §3.2.122: "+ ANINP_OFFSET", in all modes.
TEST(Terminals, AninpHasItsOffset) {
    MotorBench b;
    b.motor.terminals().set_analogue(2'000);  // 204.6
    b.set(123, -10);
    b.samples(1);
    EXPECT_EQ(b.reg(ANINP), 194);
    b.set(MODE_REG, 2);
    b.motor.terminals().set_analogue(0);
    b.samples(1);
    EXPECT_EQ(b.reg(ANINP), -10);
}

TEST(Terminals, ASensorSwitchesWhereItStands) {
    Terminals terminals;
    terminals.connect({.counts = 100, .on_above = true});
    EXPECT_EQ(terminals.millivolts(100), 0);
    EXPECT_EQ(terminals.millivolts(101), 10'000);
    terminals.connect({.counts = -100, .on_above = false});
    EXPECT_EQ(terminals.millivolts(-100), 0);
    EXPECT_EQ(terminals.millivolts(-101), 10'000);
    terminals.set_analogue(3'000);
    EXPECT_EQ(terminals.millivolts(-101), 3'000);
}

constexpr std::chrono::nanoseconds kSample{1'920'000};

/// As MAC50-141's pins are with `control` in CNTRL_BITS at power-up.
PulseInput pulse_input(std::int32_t control) {
    PulseInput input;
    input.configure(registers::Model::mac140, control, 0);
    return input;
}

// 5000 a second x 1.92 ms = 9.6 a sample: 48 in five, none lost.
TEST(Terminals, PulsesKeepTheirFractions) {
    Terminals terminals;
    terminals.set_pulse_rate(5'000);
    int sum = 0;
    for (int i = 0; i < 5; ++i) {
        const int pulses = terminals.next_pulses(kSample, pulse_input(0));
        EXPECT_TRUE(pulses == 9 || pulses == 10) << pulses;
        sum += pulses;
    }
    EXPECT_EQ(sum, 48);
    terminals.set_pulse_rate(-5'000);
    for (int i = 0; i < 5; ++i) sum += terminals.next_pulses(kSample, pulse_input(0));
    EXPECT_EQ(sum, 0);
}

/// Counts in 100 samples (0.192 s).
int counted(std::int32_t per_second, PulseFormat format, std::int32_t control) {
    Terminals terminals;
    terminals.set_pulse_rate(per_second, format);
    int sum = 0;
    for (int i = 0; i < 100; ++i) sum += terminals.next_pulses(kSample, pulse_input(control));
    return sum;
}

// 001 §3.2.36 bit 2. R: the wrong setting counts one edge of four, or to and fro. 100,000 / s x 0.192 s.
TEST(Terminals, PulseFormats) {
    constexpr std::int32_t kPulseDir = 4, kInpSign = 8;
    using enum PulseFormat;
    EXPECT_EQ(counted(100'000, quadrature, 0), 19'200);
    EXPECT_EQ(counted(30'000, pulse_and_direction, kPulseDir), 5'760);
    EXPECT_EQ(counted(-30'000, pulse_and_direction, kPulseDir | kInpSign), 5'760);
    EXPECT_EQ(counted(100'000, quadrature, kPulseDir), 4'800);
    EXPECT_EQ(counted(30'000, pulse_and_direction, 0), 0);
}

// 001 §3.2.36 bit 4: 31 kHz, with HICLK 1 MHz. Four counts are a period of a quadrature signal.
TEST(Terminals, PulseFilter) {
    constexpr std::int32_t kPulseDir = 4, kHiClk = 0x10;
    using enum PulseFormat;
    EXPECT_EQ(counted(124'000, quadrature, 0), 23'808);
    EXPECT_EQ(counted(124'004, quadrature, 0), 0);
    EXPECT_EQ(counted(31'000, pulse_and_direction, kPulseDir), 5'952);
    EXPECT_EQ(counted(31'001, pulse_and_direction, kPulseDir), 0);
    EXPECT_EQ(counted(1'000'000, pulse_and_direction, kPulseDir | kHiClk), 192'000);
    EXPECT_EQ(counted(1'000'000, quadrature, kHiClk), 192'000);
}

/// A motor whose user interface was set up with these bits when it was switched on.
MotorBench with_control_bits(std::int32_t bits) {
    MotorBench b;
    b.set(CNTRL_BITS, bits);
    b.motor.store_registers();
    b.motor.power_cycle();
    return b;
}

// 001 §3.2.36: USERINTF 00 is pulses, 01 an encoder output, 11 communication, each on the same pins; INPSIGN
// turns the sign. Changed bits take effect at power-up only. 10,000 / s are 19.2 a sample.
TEST(Terminals, PulsesNeedTheirPins) {
    MotorBench pulses = with_control_bits(0);
    pulses.motor.terminals().set_pulse_rate(10'000);
    pulses.samples(1);
    EXPECT_EQ(pulses.reg(V_EXT), 19);
    pulses.set(CNTRL_BITS, 3);
    pulses.samples(1);
    EXPECT_NE(pulses.reg(V_EXT), 0);

    MotorBench inverted = with_control_bits(8);
    inverted.motor.terminals().set_pulse_rate(10'000);
    inverted.samples(1);
    EXPECT_EQ(inverted.reg(V_EXT), -19);

    for (const int other_use : {1, 3}) {
        MotorBench b = with_control_bits(other_use);
        b.motor.terminals().set_pulse_rate(10'000);
        b.samples(5);
        EXPECT_EQ(b.reg(V_EXT), 0) << other_use;
    }
}

// R: MAC800 has two channels, HW_SETUP and no USERINTF (004). 10,000 / s at 770 Hz are 12.987 a sample.
TEST(Terminals, Mac800CountsPulsesBesideTheLine) {
    MotorBench b(registers::Model::mac800);
    b.motor.terminals().set_pulse_rate(10'000);
    b.samples(1);
    EXPECT_EQ(b.reg(163), 12);
    b.command(protocol::fastmac::Number::nop);
    b.samples(2);
    EXPECT_EQ(b.reg(163), 13);
    EXPECT_FALSE(b.sent.empty());
    b.set(39, 0x40);  // INVXDIR, from the next power-up on
    b.motor.store_registers();
    b.motor.power_cycle();
    b.samples(2);
    EXPECT_EQ(b.reg(163), -13);
}

// 001 §3.2.120: in velocity and position mode V_EXT stands still.
TEST(Terminals, VExtIsUpdatedInItsModesOnly) {
    MotorBench b(registers::Model::mac800);
    b.motor.terminals().set_pulse_rate(77'000);  // 100 a sample
    b.samples(2);
    const std::int32_t before = b.reg(163);
    EXPECT_NEAR(before, 100, 1);
    b.set(MODE_REG, 2);
    b.motor.terminals().set_pulse_rate(0);
    b.samples(5);
    EXPECT_EQ(b.reg(163), before);
    b.set(MODE_REG, 3);
    b.samples(1);
    EXPECT_EQ(b.reg(163), 0);
}

}  // namespace
}  // namespace nplc::sim
