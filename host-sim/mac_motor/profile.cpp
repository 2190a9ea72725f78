#include "sim/profile.h"

#include <algorithm>
#include <cmath>

namespace nplc::sim {

std::int32_t velocity_block(std::int32_t wanted, std::int32_t v_old, std::int32_t acceleration) {
    return v_old + std::clamp(wanted - v_old, -acceleration, acceleration);
}

// v, v - a, v - 2a ... down to 0 with v = q a + r covers q (q + 1) / 2 a + (q + 1) r.
std::int64_t fastest_that_can_stop(std::int64_t distance, std::int64_t acceleration) {
    if (acceleration == 0) return 0;
    const auto steps = [&](std::int64_t q) { return q * (q + 1) / 2 * acceleration; };
    auto q = static_cast<std::int64_t>(
        (std::sqrt(8.0 * static_cast<double>(distance) / static_cast<double>(acceleration) + 1.0) - 1.0) / 2);
    while (steps(q) > distance) --q;
    while (steps(q + 1) <= distance) ++q;
    return q * acceleration + (distance - steps(q)) / (q + 1);
}

std::int32_t position_block(std::int64_t distance, std::int32_t v_old, std::int32_t limit,
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
