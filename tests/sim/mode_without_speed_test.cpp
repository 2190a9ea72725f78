// INIT's offsets, MANI, TESTU, TESTA, BREAK, TESTKI (001 §4.4.1, §4.4.8 to §4.4.11, §4.4.23).
#include <cstdlib>
#include <utility>

#include "motor_bench.h"
#include "protocol/mactalk.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int SAMPLE1 = 112, REC_CNT = 116;
constexpr int kRecord = 1 << 6, kRewind = 1 << 7, kInner = 1 << 8;

// 001 §3.2.140: adjusted in INIT until no current is measured; 1000 to 1050 is typical.
TEST(ModeWithoutSpeed, InitAdjustsTheCurrentOffsets) {
    MotorBench b;
    for (int n = 0; n < 3; ++n) b.set(140 + n, 980);
    b.samples(100);
    for (int n = 0; n < 3; ++n) {
        EXPECT_EQ(b.reg(137 + n), 0) << "IA_IST ...";
        EXPECT_GE(b.reg(140 + n), 1000);
        EXPECT_LE(b.reg(140 + n), 1050);
    }
    b.set(MODE_REG, 2);
    b.samples(2);
    b.set(140, 1000);
    b.samples(50);
    EXPECT_EQ(b.reg(140), 1000) << "in INIT only";
}

TEST(ModeWithoutSpeed, ManiHasNoFollowError) {
    MotorBench b;
    b.set(MODE_REG, 7);
    b.samples(20);
    EXPECT_EQ(b.reg(MODE_REG), 7);
    EXPECT_EQ(b.reg(FLWERR), 0);
    EXPECT_EQ(b.reg(FNCERR), 0);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x10, 0);
    EXPECT_EQ(b.reg(FNC_OUT), 0);
    b.set(MODE_REG, 0);
    EXPECT_EQ(b.reg(MODE_REG), 0) << "it is not assumed to turn";
}

/// The next recorded sample over MacTalk: its first two words.
std::pair<int, int> next_sample(MotorBench& b) {
    const auto request =
        protocol::mactalk::encode({.kind = protocol::mactalk::Kind::read_samples, .address = 1});
    for (const std::uint8_t byte : request.view()) b.motor.receive_mactalk(byte, false);
    std::vector<int> answer;
    while (const auto byte = b.motor.transmit_mactalk()) answer.push_back(*byte);
    const auto word = [&](std::size_t n) {  // after 52h x3, address and length, each byte with its inverse
        return static_cast<int>(static_cast<std::int16_t>(answer.at(7 + 4 * n) | answer.at(9 + 4 * n) << 8));
    };
    return {word(0), word(1)};
}

// 001 §4.4.9: registers 145 and 139, REWIND, RECINNER, RECORD, 11 samples of the inner loop, INIT. UA_VAL =
// UMEAS, UC_VAL = -UMEAS, so the current of the third phase grows negative.
TEST(ModeWithoutSpeed, TestU) {
    MotorBench b;
    b.set(130, 40);
    b.set(MODE_REG, 8);
    EXPECT_EQ(b.reg(SAMPLE1), 145);
    EXPECT_EQ(b.reg(SAMPLE1 + 1), 139);
    EXPECT_EQ(b.reg(CNTRL_BITS) & 0x1FFF, 3 | kRewind | kInner);
    b.samples(1);
    EXPECT_EQ(b.reg(CNTRL_BITS) & 0x1FFF, 3 | kRecord | kInner);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.reg(REC_CNT), 11);
    EXPECT_EQ(b.reg(CNTRL_BITS) & (kRecord | kRewind), 0);
    b.samples(20);
    EXPECT_EQ(b.reg(REC_CNT), 11);
    EXPECT_LE(std::abs(b.motor.v_ist()), 1);
    b.set(CNTRL_BITS, 3 | kRewind);
    int last = 0;
    for (int n = 0; n < 11; ++n) {
        const auto [ua_val, ic_ist] = next_sample(b);
        EXPECT_EQ(ua_val, 40) << n;
        EXPECT_LE(ic_ist, last) << n;
        last = ic_ist;
    }
    EXPECT_LT(last, -5);
}

// 001 §4.4.10, §4.4.11: registers 7 and 12, RECINNER 0, T_SOLL for 11 samples, then against the motion, then
// INIT. Of MAC800 the numbers are the same.
TEST(ModeWithoutSpeed, TestAAndBreak) {
    for (const auto model : {registers::Model::mac140, registers::Model::mac800}) {
        MotorBench b(model);
        const bool big = model == registers::Model::mac800;
        const int vf_out = big ? 169 : 121, sample1 = big ? 158 : 112, rec_cnt = big ? 162 : 116;
        b.set(T_SOLL, 60);
        b.set(CNTRL_BITS, b.reg(CNTRL_BITS) | (big ? 4 : kInner));
        b.set(MODE_REG, 9);
        EXPECT_EQ(b.reg(sample1), 7);
        EXPECT_EQ(b.reg(sample1 + 1), 12);
        EXPECT_EQ(b.reg(CNTRL_BITS) & (big ? 4 : kInner), 0);
        int samples = 0;
        for (; samples < 100; ++samples) {
            b.samples(1);
            if (b.reg(MODE_REG) != 9) break;
            EXPECT_EQ(b.reg(vf_out), 60);
            EXPECT_EQ(b.reg(rec_cnt), samples + 1);
        }
        EXPECT_EQ(samples, 11);
        EXPECT_EQ(b.reg(MODE_REG), 10);
        EXPECT_GT(b.motor.v_ist(), 0);
        for (samples = 0; b.reg(MODE_REG) == 10 && samples < 100; ++samples) {
            EXPECT_EQ(b.reg(vf_out), -60);
            b.samples(1);
        }
        EXPECT_LE(samples, 13) << "the same torque, and friction";
        EXPECT_EQ(b.reg(MODE_REG), 0);
        EXPECT_EQ(b.reg(rec_cnt), 11);
        EXPECT_EQ(b.reg(T_SOLL), 60) << "R: the register keeps its sign";
        b.samples(50);
        EXPECT_EQ(b.motor.v_ist(), 0);
    }
}

// R: BREAK asked for in motion brakes either way; standing still it is INIT at once.
TEST(ModeWithoutSpeed, BreakByRequest) {
    for (const int v_soll : {800, -800}) {
        MotorBench b;
        b.set(V_SOLL, v_soll);
        b.set(MODE_REG, 1);
        b.samples(100);
        b.set(T_SOLL, 50);
        b.set(MODE_REG, 10);
        b.samples(1);
        EXPECT_EQ(b.reg(VF_OUT), v_soll > 0 ? -50 : 50);
        b.samples(50);
        EXPECT_EQ(b.reg(MODE_REG), 0);
        EXPECT_EQ(b.motor.v_ist(), 0);
    }
    MotorBench b;
    b.set(MODE_REG, 10);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

// 001 §4.1.8: an error stops a test too, through STOP, from the velocity that the shaft has.
TEST(ModeWithoutSpeed, AnErrorEndsTestAThroughStop) {
    MotorBench b;
    b.set(A_SOLL, 50);
    b.set(T_SOLL, 200);
    b.set(MAX_P_IST, 500);
    b.set(MODE_REG, 9);
    while (b.reg(MODE_REG) == 9) b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    EXPECT_EQ(b.reg(CNTRL_BITS) & kRecord, 0);
    const int v = b.motor.v_ist();
    ASSERT_GT(v, 100);
    b.samples(1);
    EXPECT_EQ(b.reg(FNC_OUT), 16 * v - 50);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.v_ist(), 0);
    EXPECT_EQ(b.reg(P_FNC), 16 * b.motor.p_ist());
}

// 001 §4.4.23, §3.2.148: nominal 256. R: the virtual motor's circuits are exact.
TEST(ModeWithoutSpeed, TestKiFindsTheNominalGains) {
    MotorBench b;
    for (int n = 0; n < 3; ++n) b.set(148 + n, 200);
    b.set(MODE_REG, 22);
    b.samples(1);
    for (int n = 0; n < 3; ++n) EXPECT_EQ(b.reg(148 + n), 256);
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

// 004: MAN_NO_BRAKE. MAC50-141 have no such output.
TEST(ModeWithoutSpeed, BrakeOutputOfMac800) {
    MotorBench b(registers::Model::mac800);
    EXPECT_TRUE(b.motor.brake_output());
    b.set(MODE_REG, 2);
    EXPECT_FALSE(b.motor.brake_output());
    b.set(MODE_REG, 0);
    b.samples(2);
    EXPECT_TRUE(b.motor.brake_output());
    b.set(CNTRL_BITS, 0x80);
    EXPECT_FALSE(b.motor.brake_output());
    EXPECT_FALSE(MotorBench().motor.brake_output());
}

}  // namespace
}  // namespace nplc::sim
