#include "sim/gear.h"

#include <algorithm>

#include "sim/profile.h"

namespace nplc::sim {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 44;

}  // namespace

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

}  // namespace nplc::sim
