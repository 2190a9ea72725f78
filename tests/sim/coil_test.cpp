// COIL_MODE (001 §4.4.20).
#include "sim/profile_blocks.h"

#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

// The manual's typical setup: threads at 10000 and 60000, stops at 12000 and 58000, start at 12000 to the
// right.
constexpr Coil::Setup kTypical{10'000, 12'000, 58'000, 60'000, 12'000, 1};

struct Winding {
    Coil coil;
    Coil::Setup setup = kTypical;

    /// Where the wire is after so many counts of travel, as P_SOLL would have it.
    std::int64_t after(std::int64_t counts) {
        coil.step(setup, false, 16 * counts);
        return coil.target_16(setup, -1) / 16;
    }
    std::int64_t start() {
        coil.step(setup, true, 999);
        return coil.target_16(setup, -1) / 16;
    }
};

// From 12000 right: 46,000 to the stop, 2,000 to the thread and 2,000 back while it waits there, then left.
TEST(Coil, GoesToAndFroAndWaitsAtTheStops) {
    Winding w;
    EXPECT_EQ(w.start(), 12'000);
    EXPECT_EQ(w.after(20'000), 32'000);
    EXPECT_EQ(w.after(26'000), 58'000);
    EXPECT_EQ(w.after(2'000), 58'000);
    EXPECT_EQ(w.after(2'000), 58'000);
    EXPECT_EQ(w.after(1), 57'999);
    EXPECT_EQ(w.after(45'999), 12'000);
    EXPECT_EQ(w.after(4'000), 12'000) << "2,000 to the left thread and 2,000 back";
    EXPECT_EQ(w.after(1), 12'001);
}

// Without stops (figure A) it turns at the threads themselves.
TEST(Coil, WithoutStopsItTurnsAtTheThreads) {
    Winding w;
    w.setup.left_stop = 10'000;
    w.setup.right_stop = 60'000;
    w.start();
    EXPECT_EQ(w.after(48'000), 60'000);
    EXPECT_EQ(w.after(1), 59'999);
}

// A layer there and back is 100,000 counts, whatever the portions; the spindle backwards unwinds.
TEST(Coil, LayersAddUpToNothing) {
    Winding w;
    w.start();
    EXPECT_EQ(w.after(100'000), 12'000);
    EXPECT_EQ(w.after(1'020'000), 32'000);
    EXPECT_EQ(w.after(-1'020'000), 12'000);
    EXPECT_EQ(w.after(50'000), 58'000) << "62,000 is 58,000 on the way back";
    EXPECT_EQ(w.after(-30'000), 32'000);
}

TEST(Coil, StartsToTheLeft) {
    Winding w;
    w.setup.start = 30'000;
    w.setup.direction = -1;
    EXPECT_EQ(w.start(), 30'000);
    EXPECT_EQ(w.after(5'000), 25'000);
}

// Note of §4.4.20: a start position command comes first.
TEST(Coil, NothingMovesBeforeTheFirstStart) {
    Winding w;
    EXPECT_EQ(w.after(5'000), 0) << "-1 / 16: here";
    w.start();
    w.coil.forget();
    EXPECT_EQ(w.after(5'000), 0);
}

// R: rules broken, nothing moves.
TEST(Coil, AWrongSetupMovesNothing) {
    for (const auto& setup : {Coil::Setup{10, 9, 20, 30, 15, 1}, Coil::Setup{10, 15, 14, 30, 15, 1},
                              Coil::Setup{10, 15, 40, 30, 15, 1}}) {
        Winding w;
        w.setup = setup;
        w.start();
        EXPECT_EQ(w.coil.target_16(setup, 77), 77);
        EXPECT_FALSE(w.coil.started());
    }
    Winding narrow;
    narrow.setup = {10, 10, 10, 10, 10, 1};
    EXPECT_EQ(narrow.start(), 10);
    EXPECT_EQ(narrow.after(1'000), 10);
}

// R: a thread or stop that is moved while it winds counts from the next sample on; a place beyond it comes
// in.
TEST(Coil, ThreadsAndStopsMayBeMovedWhileItWinds) {
    Winding w;
    w.start();
    EXPECT_EQ(w.after(40'000), 52'000);
    w.setup.right_stop = 50'000;  // P3
    EXPECT_EQ(w.after(0), 50'000);
    w.setup.right_thread = 55'000;  // P4: 52,000 + 4,000 are 1,000 beyond it
    EXPECT_EQ(w.after(4'000), 50'000);
    EXPECT_EQ(w.after(4'001), 49'999) << "54,000 to the left less 4,001";
    w.setup.left_thread = 45'000;  // P1, and P2
    w.setup.left_stop = 46'000;
    EXPECT_EQ(w.after(5'000), 46'000) << "4,999 to the thread and 1 back: 45,001";
    EXPECT_EQ(w.after(1'000), 46'001);
    w.setup.start = 47'000;  // P5 and P6: nothing before the next start
    w.setup.direction = -1;
    EXPECT_EQ(w.after(10), 46'011);
    EXPECT_EQ(w.start(), 47'000);
    EXPECT_EQ(w.after(10), 46'990);
}

// R: a setup that breaks the rules meanwhile is where the motor stops; mended, it goes on from the place it
// had.
TEST(Coil, AWrongSetupWhileItWindsStops) {
    Winding w;
    w.start();
    w.after(20'000);
    w.setup.left_stop = 59'000;
    w.coil.step(w.setup, false, 16 * 500);
    EXPECT_EQ(w.coil.target_16(w.setup, 77), 77);
    w.setup.left_stop = 12'000;
    EXPECT_EQ(w.after(500), 32'500);
}

MotorBench coiling() {
    MotorBench b(registers::Model::mac800);
    const std::int32_t setup[] = {10'000, 12'000, 58'000, 60'000, 12'000, 1};
    for (int n = 0; n < 6; ++n) b.set(P1 + 2 * n, setup[n]);
    b.set(V1 + 7, 0);  // V8
    b.set(V_SOLL, 8000);
    b.set(MODE_REG, 19);
    return b;
}

// AIN high: to P5; low: the coil is wound. 100 pulses a sample x 1 / 1: 460 samples to the stop at 58,000.
TEST(Coil, TheMotorWinds) {
    MotorBench b = coiling();
    b.motor.terminals().set_pulse_rate(77'000);
    b.samples(100);
    EXPECT_EQ(b.motor.p_ist(), 0) << "not started";
    b.motor.terminals().set_analogue(10'000);
    b.samples(400);
    EXPECT_EQ(b.motor.p_ist(), 12'000);
    EXPECT_TRUE(b.motor.in_position());
    b.motor.terminals().set_analogue(0);
    std::int32_t farthest = 0;
    for (int i = 0; i < 499; ++i) {
        b.samples(1);
        farthest = std::max(farthest, b.reg(P_FNC));
    }
    EXPECT_EQ(farthest, 16 * 58'000) << "§4.1.12 stops without overshoot";
    EXPECT_NEAR(b.reg(P_FNC) / 16, 58'000, 2) << "it waits for the thread and back: 40 samples";
    b.samples(200);
    EXPECT_LT(b.reg(166), 0) << "to the left";
    for (int i = 0; i < 3000; ++i) {
        b.samples(1);
        ASSERT_GE(b.reg(P_FNC), 16 * 12'000);
        ASSERT_LE(b.reg(P_FNC), 16 * 58'000);
    }
}

// V8 is added to V_EXT: the spindle simulated at 100 a sample.
TEST(Coil, V8TurnsTheSpindle) {
    MotorBench b = coiling();
    b.motor.terminals().set_analogue(10'000);
    b.samples(400);
    b.motor.terminals().set_analogue(0);
    b.set(V1 + 7, 100);
    b.samples(1);
    EXPECT_EQ(b.reg(163), 100);
    b.samples(199);
    EXPECT_NEAR(b.motor.v_ist(), 100, 2);
    EXPECT_NEAR(b.reg(P_FNC) / 16 - b.reg(165) / 16, 12'000 + 200 * 100, 1)
        << "P_FNC less G_FNC: the traverse";
}

// Homing at power-up, then a start, then the coil. HOME3 ends with the sensor off; R: where HOME2 leaves it
// on, that is a start command, for both may be one wire.
TEST(Coil, AfterPowerUpHomingAStartComesFirst) {
    MotorBench b = coiling();
    b.set(MODE_REG, 0);
    b.set(HOME_MODE, 14);
    b.set(STARTMODE, 19);
    b.set(T_HOME, 1);
    b.motor.store_registers();
    b.motor.terminals().connect({.counts = -2000, .on_above = false});
    b.motor.terminals().set_pulse_rate(77'000);
    b.motor.power_cycle();
    EXPECT_EQ(b.reg(MODE_REG), 14);
    while (b.reg(MODE_REG) == 14) b.samples(1);
    EXPECT_EQ(b.reg(MODE_REG), 19);
    b.motor.terminals().set_analogue(0);
    b.samples(200);
    const std::int32_t stands = b.motor.p_ist();
    b.samples(200);
    EXPECT_NEAR(b.motor.p_ist(), stands, 1);
    b.motor.terminals().set_analogue(10'000);
    b.samples(400);
    EXPECT_EQ(b.motor.p_ist(), 12'000);
    b.motor.terminals().set_analogue(0);
    b.samples(100);
    EXPECT_GT(b.motor.p_ist(), 12'500);
}

}  // namespace
}  // namespace nplc::sim
