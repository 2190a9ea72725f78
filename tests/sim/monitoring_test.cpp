// 001 §4.5 and MAC800's errors (004): what provokes each, what it does, and how it is cleared.
#include <functional>
#include <vector>

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr std::int32_t kSecond = 521;  // samples of 1.92 ms
constexpr int kUvHandle = 160, kUMinSup = 152, kUSupply = 151;
constexpr std::int32_t kUvErr = 1 << 12, kUvDetect = 1 << 13;

/// A motor that runs, with an emergency acceleration that shows. MAC50-141: 100 counts/sample, MAC800 173.
MotorBench running(registers::Model model = registers::Model::mac140) {
    MotorBench b(model);
    b.set(ACC_EMERG, 100);
    b.set(MODE_REG, 1);
    b.samples(100);
    EXPECT_EQ(b.reg(MODE_REG), 1);
    return b;
}

int fnc_out(const MotorBench& b) {
    return b.motor.model() == registers::Model::mac800 ? b.reg(166) / 0x10000 : b.reg(FNC_OUT);
}

/// Through STOP with ACC_EMERG to INIT, `bit` set, out of which nothing leads before `reset error`; and again
/// if the cause is still there.
void expect_error(MotorBench& b, std::int32_t bit, const std::function<void()>& heal) {
    EXPECT_NE(b.reg(ERR_STAT) & bit, 0);
    ASSERT_EQ(b.reg(MODE_REG), 11);
    const int before = fnc_out(b);
    b.samples(1);
    EXPECT_EQ(fnc_out(b), before - 100) << "ACC_EMERG";
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.v_ist(), 0);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 0) << "001 §3.2.35: to be reset first";
    heal();
    b.samples(600);
    EXPECT_NE(b.reg(ERR_STAT) & bit, 0) << "it stays until it is reset";
    b.command(protocol::fastmac::Number::reset_error);
    b.samples(2);
    EXPECT_EQ(b.reg(ERR_STAT) & bit, 0);
    b.set(MODE_REG, 2);
    EXPECT_EQ(b.reg(MODE_REG), 2);
}

void until_stop(MotorBench& b, int limit = 2000) {
    for (int i = 0; i < limit && b.reg(MODE_REG) != 11; ++i) b.samples(1);
}

TEST(Monitoring, FollowError) {
    MotorBench b = running();
    b.set(FLWERRMAX, 300);
    b.motor.plant().load().torque = -3000;
    until_stop(b);
    b.motor.plant().load().torque = 0;
    EXPECT_GT(b.reg(FLWERR), 300);
    // The shaft was thrown back meanwhile: only that it ends well.
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 2);
    EXPECT_EQ(b.status() & 1, 1);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.reg(FLWERR), 0);
    b.command(protocol::fastmac::Number::reset_error);
    EXPECT_EQ(b.status() & 1, 0);
}

TEST(Monitoring, PositionLimit) {
    MotorBench b = running();
    b.set(MAX_P_IST, 20'000);
    until_stop(b);
    EXPECT_GT(b.motor.p_ist(), 20'000);
    EXPECT_LE(b.motor.p_ist(), 20'000 + 101);
    expect_error(b, 1 << 7, [&] { b.set(P_IST, 0); });
}

// 001 §3.2.22, §3.2.26, §4.5.3: a limit of 0 is none.
TEST(Monitoring, LimitsOfZeroAreNone) {
    MotorBench b = running();
    for (const int limit : {FLWERRMAX, FNCERRMAX, MIN_P_IST, MAX_P_IST}) b.set(limit, 0);
    b.motor.plant().load().torque = -900;
    b.samples(2000);
    EXPECT_EQ(b.reg(ERR_STAT) & 0xFF & ~0x70, 0);
}

// Of heat nothing like that is said (001 §4.5.1, §4.5.2; 004, DEGCMAX): above 0 is above.
TEST(Monitoring, AHeatLimitOfZeroIsOne) {
    MotorBench b = running();
    b.set(I2T, 50);
    b.set(I2TLIM, 0);
    b.samples(1);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0x01);
    MotorBench c = running(registers::Model::mac800);
    c.set(UIT, 50);
    c.set(UITLIM, 0);
    c.samples(1);
    EXPECT_EQ(c.reg(ERR_STAT) & 0x0F, 0x08);
    MotorBench d = running(registers::Model::mac800);
    d.set(31, 0);
    d.samples(1);
    EXPECT_NE(d.reg(ERR_STAT) & 1 << 8, 0);
}

// 001 §4.5.6 with U_MIN_SUP 400: below 400 it is low, well above 500 (1.25 x). Without a bit in UV_HANDLE
// nothing but UV_DETECT happens, and that for a second more.
TEST(Monitoring, UndervoltageIsDetected) {
    MotorBench b = running();
    b.set(kUMinSup, b.reg(kUSupply) / 2);
    b.samples(5);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvDetect, 0);
    b.set(kUMinSup, b.reg(kUSupply) + 50);
    b.samples(1);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvErr, 0);
    b.samples(100);
    EXPECT_EQ(b.reg(MODE_REG), 1);
    EXPECT_NE(b.reg(V_SOLL), 0);
    b.set(kUMinSup, b.reg(kUSupply) * 9 / 10);  // enough, but not 1.25 x
    b.samples(2 * kSecond);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
    b.set(kUMinSup, b.reg(kUSupply) / 2);
    b.samples(1);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvDetect, 0) << "the second was over long ago";
}

TEST(Monitoring, UndervoltageTimerIsASecond) {
    MotorBench b = running();
    b.set(kUMinSup, b.reg(kUSupply) + 50);
    b.samples(1);
    b.set(kUMinSup, b.reg(kUSupply) / 2);
    b.samples(kSecond - 1);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
    b.samples(1);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvDetect, 0);
}

// In INIT the timer is preset below 1.25 x U_MIN_SUP already.
TEST(Monitoring, InInitTheSupplyHasToBeWell) {
    MotorBench b;
    b.samples(2);
    b.set(kUMinSup, b.reg(kUSupply) * 9 / 10);
    b.samples(1);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
    b.set(kUMinSup, b.reg(kUSupply) / 2);
    b.samples(kSecond - 1);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
    b.samples(1);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvDetect, 0);
    EXPECT_EQ(b.reg(MODE_REG), 0);
}

// Bit 0: the error bit alone; it does not stop, but INIT is not left with it.
TEST(Monitoring, UndervoltageBit0SetsTheError) {
    MotorBench b = running();
    b.set(kUvHandle, 1);
    b.set(kUMinSup, b.reg(kUSupply) + 50);
    b.samples(3);
    EXPECT_NE(b.reg(ERR_STAT) & kUvErr, 0);
    EXPECT_EQ(b.reg(MODE_REG), 1);
    EXPECT_EQ(b.status() & 1, 0) << "001 §5.2.1.6: a sequence does not see it";
    b.set(kUMinSup, 0);
    b.set(MODE_REG, 0);
    b.settle();
    b.set(MODE_REG, 1);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.command(protocol::fastmac::Number::reset_error);
    b.set(MODE_REG, 1);
    EXPECT_EQ(b.reg(MODE_REG), 1);
}

// Bit 1: to INIT; with bit 0 it is an error that stays.
TEST(Monitoring, UndervoltageBit1GoesPassive) {
    MotorBench b = running();
    b.set(kUvHandle, 2);
    b.set(kUMinSup, b.reg(kUSupply) + 50);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvErr, 0);
    b.set(MODE_REG, 1);
    b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 11) << "as long as it is low";
    MotorBench c = running();
    c.set(kUvHandle, 3);
    c.set(kUMinSup, c.reg(kUSupply) + 50);
    c.samples(1);
    expect_error(c, kUvErr, [&] { c.set(kUMinSup, 0); });
}

// Bit 3 (the text over the pseudo-code: if it is set), on MAC800 bit 2.
TEST(Monitoring, UndervoltageBit3StopsByVSoll) {
    MotorBench b = running();
    b.set(kUvHandle, 4);
    b.set(kUMinSup, b.reg(kUSupply) + 50);
    b.samples(1);
    EXPECT_EQ(b.reg(V_SOLL), 1600) << "bit 2 is reserved";
    b.set(kUvHandle, 8);
    b.samples(1);
    EXPECT_EQ(b.reg(V_SOLL), 0);
    b.samples(100);
    EXPECT_EQ(b.reg(MODE_REG), 1);
    EXPECT_NEAR(b.motor.v_ist(), 0, 1);
}

// The same by the supply itself: 24 V for one of 48 V with U_MIN_SUP at 37.6 V (700 x 53.7 mV), 1.25 x
// which is 47 V.
TEST(Monitoring, ASaggingSupplyIsSeen) {
    MotorBench b;
    b.set(kUMinSup, 700);
    b.samples(5);
    EXPECT_EQ(b.reg(ERR_STAT) & kUvDetect, 0) << "U_SUPPLY " << b.reg(kUSupply);
    b.motor.supply().set_source(24);
    b.motor.supply().settle();
    b.samples(2);
    EXPECT_NEAR(b.reg(kUSupply), 447, 2);
    EXPECT_NE(b.reg(ERR_STAT) & kUvDetect, 0);
}

// 001 §3.2.18: above UITLIM and above 52 V. A load that drives the motor feeds the dump.
TEST(Monitoring, UitNeedsTheDumpsVoltage) {
    MotorBench b;
    b.set(V_SOLL, 5000);
    b.set(MODE_REG, 1);
    b.samples(300);
    b.set(UITLIM, b.reg(UIT) + 50);
    b.motor.plant().load().torque = 600;
    for (int i = 0; i < 5000 && b.reg(MODE_REG) == 1; ++i) b.samples(1);
    b.motor.plant().load().torque = 0;
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0x08);
    EXPECT_GT(b.reg(UIT), b.reg(UITLIM));
    EXPECT_GT(b.reg(kUSupply), 968) << "52 V";
    EXPECT_EQ(b.reg(MODE_REG), 11);
    b.settle();
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.status() & 1, 1);
    EXPECT_LT(b.reg(kUSupply), 968);
    b.command(protocol::fastmac::Number::reset_error);
    b.samples(2);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0) << "UIT may still be above: at 48 V nothing goes to the dump";
}

// 001 §4.5.1: full torque against a stop heats; below the limit again it can be reset.
TEST(Monitoring, I2t) {
    MotorBench b;
    b.set(I2TLIM, 2000);
    b.motor.plant().load().high_stop = MechanicalStop{100};
    b.set(P_SOLL, 100'000);
    b.set(MODE_REG, 2);
    for (int i = 0; i < 20'000 && b.reg(MODE_REG) == 2; ++i) b.samples(1);
    EXPECT_GT(b.reg(I2T), 2000);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0x01);
    EXPECT_EQ(b.status() & 1, 1);
    b.samples(2);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    b.samples(2000);
    EXPECT_LT(b.reg(I2T), 2000);
    b.command(protocol::fastmac::Number::reset_error);
    b.samples(2);
    EXPECT_EQ(b.reg(ERR_STAT) & 0x0F, 0);
}

struct Mac800Error {
    const char* name;
    std::int32_t bit;
    std::function<void(MacMotor&)> provoke, heal;
};

// 004: each stops the motor with ACC_EMERG, keeps INIT, and is cleared by "reset error" once its cause is
// gone.
TEST(Monitoring, ErrorsOfMac800) {
    const std::vector<Mac800Error> errors{
        {"temperature", 1 << 8, [](MacMotor& m) { m.surroundings().celsius = 90; },
         [](MacMotor& m) { m.surroundings().celsius = 25; }},
        {"undervoltage", 1 << 9,
         [](MacMotor& m) {
             m.write(23, 3);
             m.supply().set_source(100);
             m.supply().settle();
         },
         [](MacMotor& m) {
             m.supply().set_source(325);
             m.supply().settle();
         }},
        {"overvoltage", 1 << 11,
         [](MacMotor& m) {
             m.supply().set_source(600);
             m.supply().settle();
         },
         [](MacMotor& m) {
             m.supply().set_source(325);
             m.supply().settle();
         }},
        {"24 V", 1 << 17, [](MacMotor& m) { m.surroundings().logic_millivolts = 17'900; },
         [](MacMotor& m) { m.surroundings().logic_millivolts = 24'000; }},
    };
    for (const Mac800Error& error : errors) {
        SCOPED_TRACE(error.name);
        MotorBench b = running(registers::Model::mac800);
        b.set(31, 696);  // DEGCMAX: 85 degrees
        b.samples(5);
        EXPECT_EQ(b.reg(MODE_REG), 1);
        error.provoke(b.motor);
        b.samples(1);
        expect_error(b, error.bit, [&] { error.heal(b.motor); });
    }
}

// 004: above 3600 rpm, which is 623.4 counts/sample: 9990 / 16 = 624.4.
TEST(Monitoring, OverspeedOfMac800) {
    MotorBench b(registers::Model::mac800);
    b.set(V_SOLL, 9800);
    b.set(A_SOLL, 50);
    b.set(MODE_REG, 1);
    b.samples(400);
    EXPECT_EQ(b.reg(MODE_REG), 1) << "612 counts/sample";
    b.set(V_SOLL, 10'400);
    b.samples(100);
    EXPECT_NE(b.reg(ERR_STAT) & 1 << 13, 0);
    b.samples(400);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_FALSE(MotorBench().reg(ERR_STAT) & 1 << 13);
}

// What a broken encoder does not count is lost; the windings brake, for INIT shorts them.
TEST(Monitoring, ABrokenEncoderLosesCounts) {
    MotorBench b = running(registers::Model::mac800);
    b.samples(100);
    b.motor.surroundings().encoder_broken = true;
    const std::int32_t lost_at = b.motor.p_ist();
    const std::int64_t shaft = b.motor.plant().counts();
    b.samples(20);
    EXPECT_EQ(b.motor.v_ist(), 0);
    EXPECT_EQ(b.motor.p_ist(), lost_at);
    EXPECT_NE(b.motor.plant().counts(), shaft);
    b.samples(1000);
    EXPECT_EQ(b.reg(MODE_REG), 0);
    EXPECT_EQ(b.motor.p_ist(), lost_at);
    EXPECT_NEAR(b.motor.plant().velocity(), 0, 0.01);
}

// 004, ERR_STAT bit 16: without KFF5 or KVFX6 no velocity gives a torque.
TEST(Monitoring, OldFiltErrShowsFiltersThatCannotDrive) {
    constexpr int kKff5 = 121, kKvfx6 = 127;
    for (const int reg : {kKff5, kKvfx6}) {
        MotorBench b = running(registers::Model::mac800);
        const std::int32_t right = b.reg(reg);
        EXPECT_EQ(b.reg(ERR_STAT) & 1 << 16, 0);
        b.set(reg, 0);
        b.samples(2);
        EXPECT_NE(b.reg(ERR_STAT) & 1 << 16, 0);
        EXPECT_EQ(b.reg(MODE_REG), 1) << "shown, and nothing more";
        b.set(reg, right);
        b.samples(2);
        EXPECT_EQ(b.reg(ERR_STAT) & 1 << 16, 0);
    }
}

// 001 §3.2.35 bit 11: shown, and nothing more; an offset of -400 puts the converter at its end.
TEST(Monitoring, IxErrStopsNothing) {
    MotorBench b = running();
    b.set(140, 2047);
    b.samples(3);
    EXPECT_NE(b.reg(ERR_STAT) & 1 << 11, 0);
    EXPECT_EQ(b.reg(MODE_REG), 1);
}

// 004 bit 12, the same provoked: there it is an error.
TEST(Monitoring, IpeakErrOfMac800) {
    MotorBench b = running(registers::Model::mac800);
    b.motor.plant().load().inertia_256 = 100 * 256;  // or the wrong current would stop it before STOP does
    const std::int32_t offset = b.reg(186);
    b.set(186, 2047);
    b.samples(1);
    b.set(186, offset);
    expect_error(b, 1 << 12, [] {});
}

}  // namespace
}  // namespace nplc::sim
