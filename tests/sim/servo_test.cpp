#include <array>
#include <cmath>
#include <cstdlib>

#include "motor_bench.h"
#include "sim/servo.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
using registers::Model;

/// Registers 112 and up by their numbers of 001 §3.2.
constexpr int kFfOut = 118, kVbOut = 119, kEldegp = 125, kAmplitude = 127, kIaSoll = 133, kIaIst = 137,
              kIaOffset = 140, kEldeg = 143, kVEldeg = 144, kUSupply = 151;

// FF 2 - 1/z on FNC_OUT, VB 16, VF (0.5 z) / (z - 0.25), KVOUT 2, by hand.
TEST(SpeedRegulator, FiltersAreTheRegisters) {
    Regulator r;
    r.use({.ff = {2, -1}, .vb = {16}, .vfx = {0.5}, .vfy = {0.25}});
    const Regulator::Output first = r.step({.fnc_out = 100, .v_ist = 0, .torque_limit = 1023, .kvout = 2});
    EXPECT_EQ(first.ff_out, 200);
    EXPECT_EQ(first.vb_out, 0);
    EXPECT_EQ(first.torque, 200);  // 0.5 x 200 x 2
    const Regulator::Output second = r.step({.fnc_out = 100, .v_ist = 5, .torque_limit = 1023, .kvout = 2});
    EXPECT_EQ(second.ff_out, 100);  // 200 - 100
    EXPECT_EQ(second.vb_out, 80);
    EXPECT_EQ(second.torque, 70);  // (0.5 x 20 + 0.25 x 100) x 2
    EXPECT_EQ(second.correction, 0);
    EXPECT_EQ(r.lag_16(), 100 + 100 - 80);
}

// 001 §4.2.1: 2 x 0.5 x 2 of torque a unit of FNC_OUT: 50 of torque would have taken 25, so 75 too much; and
// the filters go on from 25.
TEST(SpeedRegulator, CorrectionIsTheVelocityThatKeepsTheTorque) {
    Regulator r;
    r.use({.ff = {2, -1}, .vb = {16}, .vfx = {0.5}, .vfy = {0.25}});
    const Regulator::Output out = r.step({.fnc_out = 100, .v_ist = 0, .torque_limit = 50, .kvout = 2});
    EXPECT_EQ(out.torque, 50);
    EXPECT_EQ(out.correction, -75);
    EXPECT_EQ(out.ff_out, 50);
    const Regulator::Output next = r.step({.fnc_out = 25, .v_ist = 0, .torque_limit = 1023, .kvout = 2});
    EXPECT_EQ(next.ff_out, 25);  // 2 x 25 - 25
    EXPECT_EQ(next.torque, 38);  // (0.5 x 25 + 0.25 x 25) x 2 = 37.5
    EXPECT_EQ(r.lag_16(), 25 + 25);
}

// 001 §3.2.5: V_SOLL 1600 is 762.9 rpm, so 1000 rpm are 2097; 004: 2771.
TEST(Servo, AThousandRpm) {
    for (const auto& [model, v_soll] : {std::pair{Model::mac140, 2097}, std::pair{Model::mac800, 2771}}) {
        MotorBench b(model);
        b.set(V_SOLL, v_soll);
        b.set(MODE_REG, 1);
        b.samples(500);
        const std::int32_t start = b.motor.p_ist();
        b.samples(1600);
        const double seconds = 1600 * static_cast<double>(b.motor.sample_period().count()) * 1e-9;
        const double turns = static_cast<double>(b.motor.p_ist() - start) / b.motor.counts_per_revolution();
        EXPECT_NEAR(turns / seconds * 60, 1000, 0.2);
    }
}

// Behind the filters a constant velocity is what it was: 1600 is 1600, and 100 counts a sample are 1600 / 16.
TEST(Servo, FilterOutputsAreVelocities) {
    MotorBench b;
    b.set(V_SOLL, 1600);
    b.set(MODE_REG, 1);
    b.samples(300);
    EXPECT_EQ(b.reg(kFfOut), 1600);
    EXPECT_NEAR(b.reg(kVEldeg), 100 / 15, 1);
    std::int64_t sum = 0;  // VB makes much of each count's jitter: its mean
    for (int i = 0; i < 2000; ++i) {
        b.samples(1);
        sum += b.reg(kVbOut);
    }
    EXPECT_NEAR(static_cast<double>(sum) / 2000, 1600, 4);
}

/// UA_VAL and IC_IST in every inner sample.
class Recorder final : public InnerWatcher {
  public:
    explicit Recorder(const MotorMemory& memory) : memory_(memory) {}
    void inner_sample() override {
        ua_val.push_back(memory_.get(cell::UA_VAL));
        ic_ist.push_back(memory_.get(cell::IA_IST[2]));
    }
    std::vector<std::int32_t> ua_val;
    std::vector<std::int32_t> ic_ist;

  private:
    const MotorMemory& memory_;
};

// 001 §4.4.9: UA_VAL = UMEAS and UC_VAL = -UMEAS for 11 samples of 7812.5 Hz. A winding of resistance R that
// keeps d of its current in a sample has U / R (1 - d^n) after n; R and d are those of the folder's README.
TEST(Servo, VoltageStepShowsTheWinding) {
    constexpr double kResistance = 0.366, kDecay = 0.9;
    MotorMemory memory(Model::mac140);
    write_defaults(memory, 1);
    Servo servo(Model::mac140, Servo::Depth::current_loop, {.friction_torque = 1023});
    const Terminals terminals;
    servo.power_up(memory);
    memory.set(cell::UMEAS, 100);
    servo.carry_out({.kind = Drive::Kind::voltage}, memory);
    Recorder recorder(memory);
    servo.advance(memory, terminals, &recorder);
    ASSERT_EQ(recorder.ua_val.size(), 15U);
    for (std::size_t n = 0; n < 11; ++n) {
        EXPECT_EQ(recorder.ua_val[n], 100);
        const double expected = -100 / kResistance * (1 - std::pow(kDecay, static_cast<double>(n)));
        EXPECT_NEAR(recorder.ic_ist[n], expected, 1) << n;
    }
    for (std::size_t n = 11; n < 15; ++n) EXPECT_EQ(recorder.ua_val[n], 0);
    EXPECT_GT(recorder.ic_ist[14], recorder.ic_ist[11]) << "and dies away";
}

// 001 §3.2.128: I_NOM x AMPLITUDE x sin: 1000 x 0.5 at 90 degrees (512 of 2048), its third -1/2 of that; and
// the currents follow.
TEST(Servo, FieldByHand) {
    MotorMemory memory(Model::mac140);
    write_defaults(memory, 1);
    memory.set(cell::AMPLITUDE, 128);
    memory.set(cell::MAN_I_NOM, 1000);
    memory.set(cell::MAN_ALPHA, 512);
    Servo servo(Model::mac140, Servo::Depth::current_loop, {});
    const Terminals terminals;
    servo.power_up(memory);
    servo.carry_out({.kind = Drive::Kind::field}, memory);
    for (int i = 0; i < 500; ++i) servo.advance(memory, terminals);
    EXPECT_EQ(memory.get(cell::IA_SOLL), 500);
    EXPECT_EQ(memory.get(cell::IA_SOLL[1]), -250);
    EXPECT_EQ(memory.get(cell::IA_SOLL[2]), -250);
    EXPECT_NEAR(memory.get(cell::IA_IST), 500, 3);
    EXPECT_NEAR(memory.get(cell::IA_IST[1]), -250, 3);
    EXPECT_NEAR(memory.get(cell::IA_IST[2]), -250, 3);
    // The rotor lies where the field gives no torque, a quarter turn of the field from it: 0 or 1024.
    const std::int32_t eldeg = memory.get(cell::ELDEG_IST) % 1024;
    EXPECT_LT(std::min(eldeg, 1024 - eldeg), 12);
}

// +/- 10 V are +/- T_SOLL, with what the input has in the very next inner sample.
TEST(Servo, AnalogueTorqueAtTheInnerRate) {
    MotorMemory memory(Model::mac140);
    write_defaults(memory, 1);
    Servo servo(Model::mac140, Servo::Depth::current_loop, {});
    Terminals terminals;
    servo.power_up(memory);
    servo.carry_out({.kind = Drive::Kind::analogue_torque, .torque_limit = 400}, memory);
    terminals.set_analogue(-5000);
    servo.advance(memory, terminals);
    EXPECT_NEAR(servo.torque(), -200, 1);
    terminals.set_analogue(10'000);
    servo.advance(memory, terminals);
    EXPECT_EQ(servo.torque(), 400);
}

// 001 §3.2.140: in INIT the offsets make the currents 0 again.
TEST(Servo, OffsetsComeBackInInit) {
    MotorBench b;
    b.samples(2);
    const std::array<int, 3> right{b.reg(kIaOffset), b.reg(kIaOffset + 1), b.reg(kIaOffset + 2)};
    for (int p = 0; p < 3; ++p) {
        EXPECT_GE(right[static_cast<std::size_t>(p)], 1000);  // 001: typically 1000 to 1050
        EXPECT_LE(right[static_cast<std::size_t>(p)], 1050);
        b.set(kIaOffset + p, right[static_cast<std::size_t>(p)] + 20 - 20 * p);
    }
    b.samples(1);
    EXPECT_NEAR(b.reg(kIaIst), 20, 1);
    b.samples(30);
    for (int p = 0; p < 3; ++p) {
        EXPECT_EQ(b.reg(kIaIst + p), 0);
        EXPECT_EQ(b.reg(kIaOffset + p), right[static_cast<std::size_t>(p)]);
    }
}

// 001 §3.2.125: the first time the hall mark passes forwards ELDEG_IST takes ELDEGP_OFFSET; with HALL_INT
// every time. 600 is 105 degrees from right: no torque forwards any more.
TEST(Servo, TheHallMarkSetsTheAngle) {
    for (const bool hall_int : {false, true}) {
        MotorBench b;
        b.set(V_SOLL, 400);
        b.set(MODE_REG, 1);
        b.samples(60);
        EXPECT_LT(b.motor.p_ist(), 2048);
        b.samples(100);
        EXPECT_GT(b.motor.p_ist(), 2048);
        EXPECT_NEAR(b.reg(kEldeg), b.motor.p_ist() % 2048, 3);
        b.set(kEldegp, 600);
        if (hall_int) b.set(CNTRL_BITS, b.reg(CNTRL_BITS) | 1 << 5);
        b.samples(300);
        const bool kept = std::abs(b.motor.v_ist() - 25) <= 2;
        EXPECT_EQ(kept, !hall_int);
    }
}

// 48 V are 48 / 0.0537 = 893.9; 52 V 968.3 (001 §3.2.151). A heavy load braked from 3000 rpm charges the bus;
// what comes back counts from 52 V on.
TEST(Supply, ThePowerDumpBeginsAt52Volts) {
    MotorBench b;
    b.motor.plant().load().inertia_256 = 10 * 256;
    b.set(KVOUT, 10 * 256);
    b.set(V_SOLL, 6291);
    b.set(A_SOLL, 20);
    b.samples(10);
    EXPECT_NEAR(b.reg(kUSupply), 894, 1);
    b.set(MODE_REG, 1);
    b.samples(600);
    EXPECT_EQ(b.reg(UIT), 0);
    EXPECT_NEAR(b.reg(kUSupply), 894, 3);
    b.set(A_SOLL, 200);
    b.set(V_SOLL, 0);
    int highest = 0;
    for (int i = 0; i < 200; ++i) {
        b.samples(1);
        highest = std::max(highest, b.reg(kUSupply));
        if (highest < 960) {
            EXPECT_EQ(b.reg(UIT), 0);
        }
    }
    EXPECT_GT(highest, 969);
    EXPECT_GT(b.reg(UIT), 0);
    // Half of 10 x 17.3E-6 kgm2 x (314 rad/s)^2 is 8.5 J; 8.5 J of 10 W x 10 s make 850 at the most.
    EXPECT_LT(b.reg(UIT), 850);
}

// 48 V are as much as the EMF at 6000 rpm, 786 counts/sample (README); 4 / pi of it if the voltage is
// no sine any more but square, and more for the current that leads. At 24 V it is half of that.
TEST(Supply, SpeedIsWhatTheVoltageCanDrive) {
    for (const double volts : {48.0, 24.0}) {
        MotorBench b;
        b.motor.supply().set_source(volts);
        b.set(V_SOLL, 30'000);
        b.set(MODE_REG, 1);
        b.samples(2000);
        EXPECT_GT(b.motor.v_ist(), 786 * volts / 48);
        EXPECT_LT(b.motor.v_ist(), 1.35 * 786 * volts / 48);
        EXPECT_NEAR(b.reg(kUSupply), volts / 0.0537, 25);
    }
}

// A third of full torque is borne for ever: I2T goes to 10,000 with 30 s. Full torque, nine times the heat,
// is there after 30 s x ln(9/8) = 3.53 s, 1840 samples (README).
TEST(Heat, I2TIsAPartialSumOfTheSquares) {
    for (const auto& [torque, samples, low, high] :
         {std::array{341, 15'625, 6000, 6600}, std::array{1023, 1740, 9000, 10'000},
          std::array{1023, 1940, 10'000, 11'000}}) {
        MotorBench b;
        b.motor.plant().load().high_stop = MechanicalStop{10};
        b.set(I2TLIM, 60'000);
        b.set(T_SOLL, torque);
        b.set(V_SOLL, 3000);
        b.set(MODE_REG, 1);
        b.samples(samples);
        EXPECT_GT(b.reg(I2T), low);
        EXPECT_LT(b.reg(I2T), high);
    }
}

// The sums go on from what is written.
TEST(Heat, I2TCanBeWritten) {
    MotorBench b;
    b.set(I2T, 9000);
    b.samples(10);
    EXPECT_NEAR(b.reg(I2T), 9000, 10);  // 10 samples of 30 s take 6 off
    b.set(I2T, 50'000);
    b.samples(1);
    EXPECT_NEAR(b.reg(I2T), 50'000, 10);
}

// README: a bus above its source falls with 0.5 s: 90 samples of 1.92 ms leave exp(-0.3456) of 48 V.
TEST(Supply, ABusAtRestEmpties) {
    MotorBench b;
    b.motor.supply().set_source(24);
    b.samples(90);
    EXPECT_NEAR(b.motor.supply().volts(), 48 * 0.7078, 0.05);
    b.samples(100);
    EXPECT_NEAR(b.motor.supply().volts(), 24, 1e-6);
}

// 004's units: 325 V are 366, 24 V of the logic supply 1787; 25 degrees are 205.
TEST(Supply, RegistersOfTheMac800) {
    MotorBench b(Model::mac800);
    b.samples(10);
    EXPECT_NEAR(b.reg(198), 366, 1);
    EXPECT_EQ(b.reg(21), 1787);
    EXPECT_NEAR(b.reg(29), 205, 1);
}

// 001 §3.2.127: AMPLITUDE times 1023 is the peak of a phase: 1023 x 212 / 256 = 847.
TEST(Servo, AmplitudeBoundsThePhaseCurrents) {
    MotorBench b;
    b.set(V_SOLL, 9000);
    b.set(A_SOLL, 3000);
    b.set(MODE_REG, 1);
    int most = 0;
    for (int i = 0; i < 20; ++i) {
        b.samples(1);
        for (int p = 0; p < 3; ++p) most = std::max(most, std::abs(b.reg(kIaSoll + p)));
    }
    EXPECT_LE(most, 847);
    EXPECT_GT(most, 600);
    EXPECT_EQ(b.reg(kAmplitude), 212);
}

}  // namespace
}  // namespace nplc::sim
