#include "sim/gear.h"

#include <algorithm>

#include "sim/profile.h"

namespace nplc::sim {

void Gear::take(std::int32_t v_ext, std::int32_t gearf1, std::int32_t gearf2) {
    if (gearf2 != divisor_) remainder_ = 0;
    divisor_ = gearf2;
    if (gearf2 == 0) return;
    constexpr std::int64_t kMost = std::int64_t{1} << 62;
    const std::int64_t wanted = std::clamp(16 * std::int64_t{v_ext} * gearf1, -kMost, kMost) + remainder_;
    g_fnc_ -= wanted / gearf2;
    remainder_ = wanted % gearf2;
}

std::int32_t gear_follow_block(std::int64_t g_fnc, std::int32_t v_old, std::int32_t limit,
                               std::int32_t acceleration) {
    const auto v_new =
        static_cast<std::int32_t>(std::clamp(-g_fnc, -std::int64_t{limit}, std::int64_t{limit}));
    return velocity_block(v_new, v_old, acceleration);
}

}  // namespace nplc::sim
