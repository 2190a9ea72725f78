#include "sim/analogue_blocks.h"

#include <algorithm>
#include <cstdlib>

#include "sim/analogue_input.h"
#include "sim/motor_memory.h"
#include "sim/profile.h"

namespace nplc::sim {
namespace {

constexpr std::int64_t kScale = 10'000'000;

std::int64_t within_10_volts(registers::Model model, std::int32_t aninp) {
    const std::int32_t full = analogue_full_scale(model);
    return std::clamp(aninp, -full, full);
}

}  // namespace

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
