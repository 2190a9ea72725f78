#pragma once

#include <cstdint>

namespace nplc::sim {

/// `value` limited to [low, high], as std::clamp. For values that are rarely outside: the bounds are tested,
/// not part of the computation, so that no later operation waits for them.
inline double within(double value, double low, double high) {
    constexpr double kHardlyEver = 0.999;
    const bool inside = value >= low && value <= high;
    if (__builtin_expect_with_probability(inside, 1, kHardlyEver)) return value;
    return value < low ? low : value > high ? high : value;
}
inline double within(double value, double limit) {
    return within(value, -limit, limit);
}

/// 1.5 x 2^52: beyond it a double has no digits after the point.
inline constexpr double kNoFraction = 6755399441055744;

/// To the nearest integer, halves to even: a cast would reduce each torque slightly.
inline std::int32_t nearest(double value) {
    return static_cast<std::int32_t>((value + kNoFraction) - kNoFraction);
}

}  // namespace nplc::sim
