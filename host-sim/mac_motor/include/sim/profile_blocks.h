#pragma once

#include <algorithm>
#include <cstdint>

#include "registers/mac.h"

namespace nplc::sim {

/// Position registers wrap around (two's complement).
constexpr std::int32_t wrap32(std::int64_t value) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value)));
}

/// The function blocks return the velocity of the next sample, FNC_OUT, from that of the last, V_OLD.
/// Velocities are in 1/16 counts/sample, accelerations in 1/16 counts/sample^2, distances in 1/16 counts.

/// 001 §4.1.1: towards `wanted`, changing by `acceleration` at the most.
inline std::int32_t velocity_block(std::int32_t wanted, std::int32_t v_old, std::int32_t acceleration) {
    return v_old + std::clamp(wanted - v_old, -acceleration, acceleration);
}

/// The highest velocity from which a motor that moves one sample with it, and slows by `acceleration` a
/// sample after that, does not pass `distance` >= 0.
std::int64_t fastest_that_can_stop(std::int64_t distance, std::int64_t acceleration);

/// 001 §4.1.2: towards a target `distance` away, as fast as possible so that the motion ends exactly on it.
/// `limit` >= 0. A velocity above the limit or too high for the distance is braked with `acceleration`; the
/// target is then passed and returned to. R: exact integer arithmetic in place of the manual's V_OLD /
/// A_SOLL, and DV = FNC_OUT - V_OLD. `braking`, not above `acceleration`, is the deceleration planned for the
/// end of the move.
inline std::int32_t position_block(std::int64_t distance, std::int32_t v_old, std::int32_t limit,
                                   std::int32_t acceleration, std::int32_t braking) {
    const bool backwards = distance < 0;
    const std::int64_t towards = backwards ? -std::int64_t{v_old} : v_old;
    const std::int64_t way = backwards ? -distance : distance;
    std::int64_t highest = std::min(towards + acceleration, std::int64_t{limit});
    // Stopping from `highest` takes no more than highest^2 / 2 braking + highest: far from the target no
    // other limit applies.
    const bool far = braking > 0 && highest * (highest + 2 * std::int64_t{braking}) <= 2 * braking * way;
    if (!far) highest = std::min(highest, fastest_that_can_stop(way, braking));
    const auto velocity = static_cast<std::int32_t>(std::max(highest, towards - acceleration));
    return backwards ? -velocity : velocity;
}

/// Electronic gearing (001 §4.1.3, §4.1.12): lag of the profile behind the pulse input, G_FNC, in 1/16
/// counts, negative while there is distance to go.
class Gear {
  public:
    void reset() { *this = {}; }

    static constexpr std::int32_t kOne = 0x10000;

    /// One sample's pulses times GEARF1 / GEARF2 times `factor` / 65536, in 1/16 counts. R: the remainder is
    /// kept for the next sample as long as GEARF2 stays; GEARF2 = 0 gives nothing.
    std::int64_t scale(std::int32_t v_ext, std::int32_t gearf1, std::int32_t gearf2,
                       std::int32_t factor = kOne);
    /// Adds a distance to follow. G_FNC stays within 2^44.
    void take(std::int64_t counts_16);
    /// The profile moved by `fnc_out` in this sample, torque correction included.
    void went(std::int32_t fnc_out) { g_fnc_ += fnc_out; }

    /// For a block with its own target.
    void stand_at(std::int64_t g_fnc) { g_fnc_ = g_fnc; }

    std::int64_t g_fnc() const { return g_fnc_; }

  private:
    std::int64_t g_fnc_ = 0;
    std::int64_t remainder_ = 0;  // 1/GEARF2/65536 of 1/16 counts
    std::int32_t divisor_ = 1;
};

/// 001 §4.1.3: the whole lag in one sample, within `limit` >= 0 and `acceleration`. Follows without lag, and
/// overshoots when the pulses stop suddenly. (The Gear Position block of §4.1.12 is position_block towards
/// -G_FNC.)
std::int32_t gear_follow_block(std::int64_t g_fnc, std::int32_t v_old, std::int32_t limit,
                               std::int32_t acceleration);

/// The traverse of COIL_MODE (001 §4.4.20): position of the wire while the spindle turns. It runs back and
/// forth between the thread positions P1 and P4; beyond the stop positions P2 and P3 the motor waits at them.
class Coil {
  public:
    struct Setup {
        std::int64_t left_thread;   ///< P1, counts; and so on
        std::int64_t left_stop;     ///< P2
        std::int64_t right_stop;    ///< P3
        std::int64_t right_thread;  ///< P4
        std::int64_t start;         ///< P5
        std::int64_t direction;     ///< P6: below 0 left, else (R) right
    };

    /// As after power-up and homing: a start command is required first.
    void forget() { *this = {}; }
    bool started() const { return started_; }

    /// One sample. `start`: the analogue input is high. `travel_16`: requested by the spindle, 1/16 counts.
    /// R: a setup that is not P1 <= P2 <= P3 <= P4 moves nothing.
    void step(const Setup& setup, bool start, std::int64_t travel_16);
    /// The motor's target, 1/16 counts; `here_16` before the first start and with an invalid setup.
    std::int64_t target_16(const Setup& setup, std::int64_t here_16) const;

  private:
    static bool usable(const Setup& setup);
    void travel(const Setup& setup, std::int64_t travel_16);

    bool started_ = false;
    bool to_the_left_ = false;
    std::int64_t place_16_ = 0;  // between the thread positions, 1/16 counts
};

/// The search for the home position, one sample at a time (001 §4.4.13 - §4.4.15): the wanted velocity, and
/// the detection of the zero. Independent of registers and motion.
class Homing {
  public:
    enum class Method : std::uint8_t {
        torque,       ///< HOME1: against a mechanical limit
        sensor_on,    ///< HOME2: where the sensor becomes active
        sensor_left,  ///< HOME3: to the sensor, and slowly off it
    };
    struct Input {
        std::int32_t v_home;  ///< 1/16 counts/sample, its sign is the direction of the search
        std::int32_t t_home;
        std::int32_t torque;  ///< VF_OUT
        bool sensor;          ///< the analogue input's level
    };
    static constexpr int kDetections = 50;

    void begin(Method method);
    Method method() const { return method_; }

    /// True: this is the zero. Not to be called after that without begin().
    bool step(const Input& input);
    /// The velocity of the search, 1/16 counts/sample.
    std::int32_t velocity() const { return velocity_; }

    /// HOME1's: 1.25 x T_HOME (001 §3.2.41).
    static std::int32_t torque_limit(std::int32_t t_home);
    /// HOME3's velocity off the sensor: -V_HOME / 64 + 1 (R: cut to an integer, 1 at the least and never
    /// towards the sensor).
    static std::int32_t creep(std::int32_t v_home);

  private:
    enum class Phase : std::uint8_t { leaving, approaching, creeping };

    bool step_torque(const Input& input);
    bool step_sensor(const Input& input);

    Method method_ = Method::torque;
    Phase phase_ = Phase::leaving;
    int detections_ = 0;
    std::int32_t velocity_ = 0;
};

/// Conversions of ANINP for the function blocks of 001 §4.1. +/- 10 V is +/- 1023, on MAC800 +/- 2048. All
/// truncated towards 0.

/// AV (001 §4.1.5): +/- 10 V is +/- V_SOLL, which is also the limit (R), with or without ANINP_OFFSET.
std::int32_t analogue_velocity(registers::Model model, std::int32_t aninp, std::int32_t v_soll);

/// AVZ (001 §4.1.6): nothing within +/- 64 (R: MAC800 128), else what is beyond it x 0.0010416 x V_SOLL.
std::int32_t analogue_velocity_with_dead_band(registers::Model model, std::int32_t aninp,
                                              std::int32_t v_soll);

/// AVG (001 §4.1.7): +/- 10 V is +/- 300 rpm, in 1/16 counts/sample.
std::int32_t analogue_trim(registers::Model model, std::int32_t aninp);

/// VAT (001 §4.4.18): |ANINP x T_SOLL / 1024| (R: MAC800 / 2048).
std::int32_t analogue_torque_limit(registers::Model model, std::int32_t aninp, std::int32_t t_soll);

/// AG (001 §4.1.9): 1.15 at 10 V, 1 at 0 V, 0.87 at -10 V, x 65536. R: 1.15 ^ (ANINP / 1023).
std::int32_t analogue_gear_factor(registers::Model model, std::int32_t aninp);

/// APOS (001 §4.1.11): the new P_SOLL. R: P_NEW there is no register.
std::int32_t analogue_position(std::int32_t aninp, std::int32_t p1, std::int32_t p2, std::int32_t p3,
                               std::int32_t p_soll);

}  // namespace nplc::sim
