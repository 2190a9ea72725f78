// Moves of a virtual motor, at random: over load factors and inertias, and with and without the current loop.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

constexpr int kMoves = NPLC_MOTOR_RUNS;
constexpr unsigned kSeed = 1;

using Random = std::mt19937;

int between(Random& random, int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

void set(MacMotor& motor, int reg, std::int32_t value) {
    motor.write(static_cast<std::uint8_t>(reg), value);
}

struct Move {
    std::int32_t velocity, acceleration, target;
};

/// Within the torque that there is: FF's lead takes up to three times what the acceleration does.
Move random_move(Random& random, int kvout) {
    return {.velocity = between(random, 100, 4000),
            .acceleration = between(random, 5, 1000 / kvout),
            .target = between(random, -20'000, 20'000)};
}

void ask(MacMotor& motor, const Move& move) {
    set(motor, V_SOLL, move.velocity);
    set(motor, A_SOLL, move.acceleration);
    set(motor, P_SOLL, move.target);
}

// Profile: V_SOLL and A_SOLL at every sample, never beyond the target, an exact end. Shaft: on the target in
// the end, and beyond it before that by no more than six times what A_SOLL adds in a sample, and 3 counts.
TEST(MotorMoves, EndExactlyOverLoadFactors) {
    Random random(kSeed);
    for (int n = 0; n < kMoves; ++n) {
        const bool big = n % 3 == 0;
        const int kvout = between(random, 1, 10);
        MacMotorOptions options;
        options.load.inertia_256 = kvout * between(random, 205, 307);  // 0.8 to 1.2 of what KVOUT says
        MacMotor motor(big ? registers::Model::mac800 : registers::Model::mac140, options);
        set(motor, KVOUT, kvout * (big ? 0x10000 : 0x100));
        set(motor, MODE_REG, 2);
        const Move move = random_move(random, kvout);
        SCOPED_TRACE("seed 1, move " + std::to_string(n));
        ask(motor, move);
        std::int32_t v_old = 0;
        std::int64_t beyond = 0;
        int settled = 0;
        for (int i = 0; i < 40'000 && settled < 400; ++i) {
            const std::int32_t before = motor.read(P_FNC);
            motor.sample();
            const std::int32_t velocity = motor.read(P_FNC) - before;
            ASSERT_LE(std::abs(velocity), move.velocity);
            ASSERT_LE(std::abs(velocity - v_old), move.acceleration);
            ASSERT_TRUE(move.target >= 0 ? velocity >= 0 : velocity <= 0);
            v_old = velocity;
            const std::int64_t past =
                move.target >= 0 ? motor.p_ist() - move.target : move.target - motor.p_ist();
            beyond = std::max(beyond, past);
            if (motor.read(P_FNC) == 16 * move.target) ++settled;
        }
        ASSERT_EQ(motor.read(P_FNC), 16 * move.target);
        ASSERT_EQ(motor.p_ist(), move.target);
        ASSERT_TRUE(motor.in_position());
        ASSERT_EQ(motor.read(FNCERR), 0);
        ASSERT_LE(beyond, 6 * move.acceleration / 16 + 3);
    }
}

// Both depths make the same moves: positions and velocities within 8 counts and what A_SOLL adds in
// three samples.
TEST(MotorMoves, OuterLoopAloneStaysCloseToTheWhole) {
    Random random(kSeed);
    std::int64_t worst_p = 0;
    std::int64_t worst_v = 0;
    for (int n = 0; n < kMoves; ++n) {
        const registers::Model model = n % 3 == 0 ? registers::Model::mac800 : registers::Model::mac140;
        MacMotor whole(model);
        MacMotor outer(model, {.depth = Servo::Depth::outer_loop});
        const Move move = random_move(random, 1);
        SCOPED_TRACE("seed 1, move " + std::to_string(n));
        for (MacMotor* motor : {&whole, &outer}) {
            set(*motor, MODE_REG, 2);
            ask(*motor, move);
        }
        const std::int64_t bound = 8 + 3 * move.acceleration / 16;
        for (int i = 0; i < 1500; ++i) {
            whole.sample();
            outer.sample();
            const std::int64_t p = std::abs(std::int64_t{whole.p_ist()} - outer.p_ist());
            const std::int64_t v = std::abs(std::int64_t{whole.v_ist()} - outer.v_ist());
            ASSERT_LE(p, bound) << "sample " << i << " A_SOLL " << move.acceleration;
            ASSERT_LE(v, bound) << "sample " << i << " A_SOLL " << move.acceleration;
            worst_p = std::max(worst_p, p);
            worst_v = std::max(worst_v, v);
        }
    }
    std::printf("worst: %lld counts, %lld counts/sample\n", static_cast<long long>(worst_p),
                static_cast<long long>(worst_v));
}

}  // namespace
}  // namespace nplc::sim
