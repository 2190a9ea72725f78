#pragma once

#include <cstdint>

namespace nplc::sim {

/// `value` cut to [low, high], as std::clamp. For what hardly ever is outside: the bounds are tested, not
/// computed with, so that nothing has to wait for them.
inline double within(double value, double low, double high) {
    constexpr double kHardlyEver = 0.999;
    const bool inside = value >= low && value <= high;
    if (__builtin_expect_with_probability(inside, 1, kHardlyEver)) return value;
    return value < low ? low : value > high ? high : value;
}
inline double within(double value, double limit) {
    return within(value, -limit, limit);
}

/// To the nearest integer, within +/-100,000: a cast alone would take a little of each torque away.
inline std::int32_t nearest(double value) {
    constexpr std::int32_t kFar = 100'000;
    return static_cast<std::int32_t>(value + (kFar + 0.5)) - kFar;
}

}  // namespace nplc::sim
