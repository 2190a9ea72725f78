// Every mode asked for in every mode (001 §4.4), the motor turning where the mode turns it.
#include <array>
#include <string_view>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

// A row a mode, a column the mode asked for:
//   .  nothing happens: the same mode, SAFE (15: only over MacTalk, §4.4.16), or a test that runs to its end
//   >  entered at once (§3.2.8: position to gear and back; R: between all that the speed regulator drives)
//   s  through STOP to INIT: INIT itself and STOP, where the motor turns (§4.1.8, §4.4.1); R: and out of
//      TESTA and BREAK
//   r  through STOP to a mode that begins at rest (R: MANI, TESTU, TESTA, TESTKI, TESTTQ)
//   c  without torque until slow, then INIT whatever was asked for (AT, §4.4.5)
constexpr std::array<std::string_view, 25> kMatrix{
    //          11111111112222
    // 012345678901234567890123 4
    ".>>>>>>>>>>s>>>.>>>>>>>>>",  // 0 INIT
    "s.>>>>>rrr>s>>>.>>>>>>rr>",  // 1 V
    "s>.>>>>rrr>s>>>.>>>>>>rr>",  // 2 P
    "s>>.>>>rrr>s>>>.>>>>>>rr>",  // 3 GP
    "cccc.cccccccccc.ccccccccc",  // 4 AT
    "s>>>>.>rrr>s>>>.>>>>>>rr>",  // 5 AV
    "s>>>>>.rrr>s>>>.>>>>>>rr>",  // 6 AVG
    ">>>>>>>.>>>s>>>.>>>>>>>>>",  // 7 MANI
    ">>>>>>>>.>>s>>>.>>>>>>>>>",  // 8 TESTU
    "s........................",  // 9 TESTA
    "s........................",  // 10 BREAK
    "s>>>>>>rrr>s>>>s>>>>>>rr>",  // 11 STOP: goes on to INIT
    "s>>>>>>rrr>s.>>.>>>>>>rr>",  // 12 HOME1
    "s>>>>>>rrr>s>.>.>>>>>>rr>",  // 13 HOME2
    "s>>>>>>rrr>s>>..>>>>>>rr>",  // 14 HOME3
    ".........................",  // 15 SAFE
    "s>>>>>>rrr>s>>>..>>>>>rr>",  // 16 AVZ
    "s>>>>>>rrr>s>>>.>.>>>>rr>",  // 17 VAT
    "s>>>>>>rrr>s>>>.>>.>>>rr>",  // 18 AG
    "s>>>>>>rrr>s>>>.>>>.>>rr>",  // 19 COIL
    "s>>>>>>rrr>s>>>.>>>>.>rr>",  // 20 A2POS
    "s>>>>>>rrr>s>>>.>>>>>.rr>",  // 21 APOS
    ">>>>>>>>>>>s>>>.>>>>>>.>>",  // 22 TESTKI
    ">>>>>>>>>>>s>>>.>>>>>>>.>",  // 23 TESTTQ
    "s>>>>>>rrr>s>>>.>>>>>>rr.",  // 24 GF
};

/// A MAC800, which has both FastMAC and pulses, as its mode drives it: 6 V, pulses, a far target, a start
/// command.
MotorBench in_mode(int mode) {
    MotorBench b(registers::Model::mac800);
    b.set(V_SOLL, 1600);
    b.set(V_HOME, 1600);
    b.set(P_SOLL, 10'000'000);
    b.set(P1, 20'000'000);
    b.set(P1 + 2, 20'000'000);  // P2: APOS
    for (const int n : {2, 3, 4}) b.set(P1 + 2 * n, 20'000'000);
    b.set(T_SOLL, mode == 4 ? 100 : 1023);
    b.set(T_HOME, mode == 12 ? 800 : 1);
    b.motor.terminals().set_pulse_rate(77'000);
    b.motor.terminals().set_analogue(mode == 13 || mode == 14 ? 0 : 6'000);
    b.samples(1);
    if (mode == 15) {
        EXPECT_TRUE(b.motor.enter_safe_mode());
        return b;
    }
    if (mode == 10 || mode == 11) {  // out of a turning motor
        b.set(MODE_REG, 1);
        b.samples(60);
        b.set(T_SOLL, 20);
        b.set(A_SOLL, 4);
    }
    b.set(MODE_REG, mode);
    const bool short_lived = mode == 0 || mode == 8 || mode == 22;
    b.samples(short_lived ? 0 : mode == 9 || mode == 10 || mode == 11 ? 3 : 30);
    EXPECT_EQ(b.reg(MODE_REG), mode);
    return b;
}

int until_another(MotorBench& b, int mode) {
    for (int i = 0; i < 20'000 && b.reg(MODE_REG) == mode; ++i) b.samples(1);
    return b.reg(MODE_REG);
}

/// What happened, in kMatrix's letters.
char outcome(int from, int to) {
    MotorBench b = in_mode(from);
    b.set(MODE_REG, to);
    const int at_once = b.reg(MODE_REG);
    if (at_once == to && from != to && to != 11) return '>';
    if (at_once == 11 && (from != 11 || to != 11)) {
        const int then = until_another(b, 11);
        if (then == 0) return 's';
        return then == to ? 'r' : '?';
    }
    if (from == 11 && to == 11) return until_another(b, 11) == 0 ? 's' : '?';
    if (at_once != from) return '?';
    if (from != 4 || to == 4 || to == 15) return '.';
    b.samples(1);
    EXPECT_EQ(b.reg(169), 0) << "VF_OUT";
    return until_another(b, 4) == 0 ? 'c' : '?';
}

TEST(ModeMatrix, EveryModeFromEveryMode) {
    for (int from = 0; from < 25; ++from) {
        std::string row;
        for (int to = 0; to < 25; ++to) row += outcome(from, to);
        EXPECT_EQ(row, kMatrix[static_cast<std::size_t>(from)]) << "from mode " << from;
    }
}

// 001 §3.2.35: an error bit keeps INIT, whatever is asked for.
TEST(ModeMatrix, AnErrorKeepsInit) {
    for (int to = 0; to < 25; ++to) {
        MotorBench b;
        b.set(ERR_STAT, 1);
        b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), 0) << to;
    }
}

// 001 §3.2.35, §4.4.1: it is INIT that cannot be left. UV_ERR alone (§3.2.160 bit 0) stops nothing, so a
// motor that runs goes on obeying orders, a stop too.
TEST(ModeMatrix, AnErrorThatStopsNothingKeepsNoOtherMode) {
    constexpr std::int32_t kUvErr = 1 << 12;
    for (const int to : {2, 3, 11, 14}) {
        MotorBench b;
        b.set(MODE_REG, 1);
        b.samples(60);
        b.set(ERR_STAT, kUvErr);
        b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), to);
        b.set(MODE_REG, 0);
        b.samples(600);
        b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), 0) << to;
    }
}

// §4.5: an error leads to INIT through STOP. R: nothing leads elsewhere before, though the error is reset.
TEST(ModeMatrix, AnErrorsStopRunsToItsEnd) {
    for (const int to : {0, 1, 2, 4, 7, 11, 12}) {
        MotorBench b;
        b.set(ACC_EMERG, 20);
        b.set(MODE_REG, 1);
        b.samples(60);
        b.motor.overload();
        EXPECT_EQ(b.reg(MODE_REG), 11);
        b.command(protocol::fastmac::Number::reset_error);
        EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0);
        b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), 11) << to;
        const std::int32_t before = b.reg(FNC_OUT);
        b.samples(1);
        EXPECT_EQ(b.reg(FNC_OUT), before - 20) << to;
        EXPECT_EQ(until_another(b, 11), 0) << to;
        if (to != 0) b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), to) << "INIT is left as ever";
    }
}

TEST(ModeMatrix, NumbersThatAreNoModes) {
    for (const int to : {25, 99, 100, 255, 256, 257, 258, 0xFFFF}) {
        MotorBench b;
        b.set(MODE_REG, 2);
        b.set(MODE_REG, to);
        EXPECT_EQ(b.reg(MODE_REG), 2) << to;
    }
}

// What INIT shows however it was come to: IN_POS, FLWERR, FNCERR 0 (§4.4.1), and no torque.
TEST(ModeMatrix, EveryModeEndsInACleanInit) {
    for (int from = 1; from < 25; ++from) {
        if (from == 15) continue;
        MotorBench b = in_mode(from);
        b.set(MODE_REG, 0);
        b.samples(6000);
        EXPECT_EQ(b.reg(MODE_REG), 0) << from;
        EXPECT_EQ(b.reg(FLWERR), 0) << from;
        EXPECT_EQ(b.reg(FNCERR), 0) << from;
        EXPECT_EQ(b.reg(169), 0) << from;
        EXPECT_EQ(b.reg(ERR_STAT) & 0x70, 0) << from;
        EXPECT_EQ(b.motor.v_ist(), 0) << from;
    }
}

}  // namespace
}  // namespace nplc::sim
