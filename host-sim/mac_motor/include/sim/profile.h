#pragma once

#include <algorithm>
#include <cstdint>

namespace nplc::sim {

/// Position registers wrap around (two's complement).
constexpr std::int32_t wrap32(std::int64_t value) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(value)));
}

/// The function blocks answer the velocity of the next sample, FNC_OUT, from that of the last, V_OLD.
/// Velocities are in 1/16 counts/sample, accelerations in 1/16 counts/sample^2, distances in 1/16 counts.

/// 001 §4.1.1: towards `wanted`, changing by `acceleration` at the most.
inline std::int32_t velocity_block(std::int32_t wanted, std::int32_t v_old, std::int32_t acceleration) {
    return v_old + std::clamp(wanted - v_old, -acceleration, acceleration);
}

/// The highest velocity from which a motor that moves one sample with it, and slows by `acceleration` a
/// sample after that, does not pass `distance` >= 0.
std::int64_t fastest_that_can_stop(std::int64_t distance, std::int64_t acceleration);

/// 001 §4.1.2: towards a target `distance` away, as fast as can still end exactly on it. `limit` >= 0. A
/// velocity above the limit or too high for the distance is braked with `acceleration`; the target is then
/// passed and returned to. R: exact integer arithmetic in place of the manual's V_OLD / A_SOLL, and DV =
/// FNC_OUT - V_OLD.
/// `braking`, not above `acceleration`, is what the plan counts on for the end of the move.
inline std::int32_t position_block(std::int64_t distance, std::int32_t v_old, std::int32_t limit,
                                   std::int32_t acceleration, std::int32_t braking) {
    const bool backwards = distance < 0;
    const std::int64_t towards = backwards ? -std::int64_t{v_old} : v_old;
    const std::int64_t way = backwards ? -distance : distance;
    std::int64_t highest = std::min(towards + acceleration, std::int64_t{limit});
    // Stopping from `highest` takes no more than highest^2 / 2 braking + highest: far from the target that is
    // all.
    const bool far = braking > 0 && highest * (highest + 2 * std::int64_t{braking}) <= 2 * braking * way;
    if (!far) highest = std::min(highest, fastest_that_can_stop(way, braking));
    const auto velocity = static_cast<std::int32_t>(std::max(highest, towards - acceleration));
    return backwards ? -velocity : velocity;
}

}  // namespace nplc::sim
