#include "sim/profile_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/motor_inputs.h"
#include "sim/motor_memory.h"

namespace nplc::sim {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 44;

constexpr std::int64_t kScale = 10'000'000;

std::int64_t within_10_volts(registers::Model model, std::int32_t aninp) {
    const std::int32_t full = analogue_full_scale(model);
    return std::clamp(aninp, -full, full);
}

}  // namespace

// v, v - a, v - 2a ... down to 0 with v = q a + r covers q (q + 1) / 2 a + (q + 1) r.
std::int64_t fastest_that_can_stop(std::int64_t distance, std::int64_t acceleration) {
    if (acceleration == 0 || distance == 0) return 0;
    const auto steps = [&](std::int64_t q) { return q * (q + 1) / 2 * acceleration; };
    auto q = static_cast<std::int64_t>(
        (std::sqrt(8.0 * static_cast<double>(distance) / static_cast<double>(acceleration) + 1.0) - 1.0) / 2);
    while (steps(q) > distance) --q;
    while (steps(q + 1) <= distance) ++q;
    return q * acceleration + (distance - steps(q)) / (q + 1);
}

std::int64_t Gear::scale(std::int32_t v_ext, std::int32_t gearf1, std::int32_t gearf2, std::int32_t factor) {
    if (gearf2 != divisor_) remainder_ = 0;
    divisor_ = gearf2;
    if (gearf2 == 0) return 0;
    constexpr std::int64_t kMostPulses = std::int64_t{1} << 20;
    const std::int64_t pulses = std::clamp<std::int64_t>(v_ext, -kMostPulses, kMostPulses);
    const std::int64_t wanted = std::clamp(16 * pulses * gearf1, -kMost, kMost) * factor + remainder_;
    const std::int64_t divisor = std::int64_t{kOne} * gearf2;
    remainder_ = wanted % divisor;
    return wanted / divisor;
}

void Gear::take(std::int64_t counts_16) {
    g_fnc_ = std::clamp(g_fnc_ - counts_16, -kMost, kMost);
}

std::int32_t gear_follow_block(std::int64_t g_fnc, std::int32_t v_old, std::int32_t limit,
                               std::int32_t acceleration) {
    const auto v_new =
        static_cast<std::int32_t>(std::clamp(-g_fnc, -std::int64_t{limit}, std::int64_t{limit}));
    return velocity_block(v_new, v_old, acceleration);
}

bool Coil::usable(const Setup& setup) {
    return setup.left_thread <= setup.left_stop && setup.left_stop <= setup.right_stop &&
           setup.right_stop <= setup.right_thread;
}

void Coil::step(const Setup& setup, bool start, std::int64_t travel_16) {
    if (!usable(setup)) return;
    if (start) {
        started_ = true;
        to_the_left_ = setup.direction < 0;
        place_16_ = 16 * std::clamp(setup.start, setup.left_thread, setup.right_thread);
    } else if (started_) {
        travel(setup, travel_16);
    }
}

/// The way there and back as a ring: from P1 to P4 in its first half, back in its second.
void Coil::travel(const Setup& setup, std::int64_t travel_16) {
    const std::int64_t left = 16 * setup.left_thread;
    const std::int64_t width = 16 * setup.right_thread - left;
    if (width == 0) {
        place_16_ = left;
        return;
    }
    const std::int64_t from_left = std::clamp<std::int64_t>(place_16_ - left, 0, width);
    const std::int64_t ring = 2 * width;
    std::int64_t on_ring = (to_the_left_ ? ring - from_left : from_left) + travel_16 % ring;
    on_ring = (on_ring % ring + ring) % ring;
    to_the_left_ = on_ring >= width;
    place_16_ = left + (to_the_left_ ? ring - on_ring : on_ring);
}

std::int64_t Coil::target_16(const Setup& setup, std::int64_t here_16) const {
    if (!started_ || !usable(setup)) return here_16;
    return std::clamp(place_16_, 16 * setup.left_stop, 16 * setup.right_stop);
}

void Homing::begin(Method method) {
    *this = {};
    method_ = method;
}

bool Homing::step(const Input& input) {
    return method_ == Method::torque ? step_torque(input) : step_sensor(input);
}

bool Homing::step_torque(const Input& input) {
    velocity_ = input.v_home;
    if (std::abs(input.torque) > std::abs(input.t_home)) ++detections_;
    return detections_ >= kDetections;
}

// The input is active high if T_HOME is positive, otherwise active low (001 §3.2.41).
bool Homing::step_sensor(const Input& input) {
    const bool active = input.sensor == (input.t_home > 0);
    bool found = false;
    if (phase_ == Phase::leaving && !active) phase_ = Phase::approaching;
    if (phase_ == Phase::approaching && active) {
        found = method_ == Method::sensor_on;
        phase_ = Phase::creeping;
    } else if (phase_ == Phase::creeping) {
        found = !active;
    }
    switch (phase_) {
        case Phase::leaving:
            velocity_ = -input.v_home;
            break;
        case Phase::approaching:
            velocity_ = input.v_home;
            break;
        case Phase::creeping:
            velocity_ = creep(input.v_home);
            break;
    }
    return found;
}

std::int32_t Homing::torque_limit(std::int32_t t_home) {
    constexpr std::int64_t kFull = 1023;
    return static_cast<std::int32_t>(std::min(std::abs(std::int64_t{t_home}) * 5 / 4, kFull));
}

std::int32_t Homing::creep(std::int32_t v_home) {
    const std::int32_t away = v_home > 0 ? -1 : 1;
    const std::int32_t velocity = -v_home / 64 + 1;
    return velocity * away > 0 ? velocity : away;
}

std::int32_t analogue_velocity(registers::Model model, std::int32_t aninp, std::int32_t v_soll) {
    return static_cast<std::int32_t>(within_10_volts(model, aninp) * v_soll / analogue_full_scale(model));
}

std::int32_t analogue_velocity_with_dead_band(registers::Model model, std::int32_t aninp,
                                              std::int32_t v_soll) {
    const std::int64_t unit = is_mac800(model) ? 2 : 1;  // its ANINP has half the step
    const std::int64_t dead = 64 * unit;
    const std::int64_t input = within_10_volts(model, aninp);
    std::int64_t beyond = 0;
    if (input > dead) beyond = input - dead;
    if (input <= -dead) beyond = input + dead;
    return static_cast<std::int32_t>(beyond * 10'416 * v_soll / (kScale * unit));
}

// 300 rpm: 4096 counts/rev at 7812.5 Hz / 15 are 629.1456, on MAC800 (004: 2.77056 an rpm) 831.168.
std::int32_t analogue_trim(registers::Model model, std::int32_t aninp) {
    const std::int64_t at_10_volts = is_mac800(model) ? 8'311'680 : 6'291'456;  // / 10'000
    return static_cast<std::int32_t>(within_10_volts(model, aninp) * at_10_volts /
                                     (std::int64_t{10'000} * analogue_full_scale(model)));
}

std::int32_t analogue_torque_limit(registers::Model model, std::int32_t aninp, std::int32_t t_soll) {
    const std::int64_t divisor = is_mac800(model) ? 2048 : 1024;
    return static_cast<std::int32_t>(std::abs(within_10_volts(model, aninp) * t_soll / divisor));
}

// e^(ln 1.15 x ANINP / full scale) as a series: integers, so that every machine has the same.
std::int32_t analogue_gear_factor(registers::Model model, std::int32_t aninp) {
    constexpr std::int64_t kOne = std::int64_t{1} << 30;
    constexpr std::int64_t kLogarithm = 150'068'242;  // ln 1.15 x 2^30
    const std::int64_t exponent = within_10_volts(model, aninp) * kLogarithm / analogue_full_scale(model);
    std::int64_t sum = kOne;
    std::int64_t term = kOne;
    for (int n = 1; n <= 8; ++n) {
        term = term * exponent / (n * kOne);
        sum += term;
    }
    return static_cast<std::int32_t>((sum + (1 << 13)) >> 14);
}

std::int32_t analogue_position(std::int32_t aninp, std::int32_t p1, std::int32_t p2, std::int32_t p3,
                               std::int32_t p_soll) {
    const std::int64_t wanted = std::int64_t{aninp} * p2 / 16 + p1;
    if (wanted < p_soll) return wanted + p3 < p_soll ? wrap32(wanted + p3) : p_soll;
    return wanted - p3 > p_soll ? wrap32(wanted - p3) : p_soll;
}

}  // namespace nplc::sim
