#include "sim/profile.h"

#include <cmath>

namespace nplc::sim {

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

}  // namespace nplc::sim
