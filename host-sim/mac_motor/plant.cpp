#include "sim/plant.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr std::int64_t kCount = 65536;
constexpr std::int64_t kFullTorque = 1023;
constexpr std::int64_t kTorqueBound = 1'000'000;
constexpr std::int64_t kFastest = 4096 * kCount;  // 31,250 rpm on MAC50-141: keeps a wild load in range

/// Friction works against motion, holds what is slower than it brakes in a sample, and never turns a shaft
/// round.
std::int64_t rubbed(std::int64_t velocity, std::int64_t friction) {
    if (velocity > friction) return velocity - friction;
    if (velocity < -friction) return velocity + friction;
    return 0;
}

}  // namespace

Plant::Plant(std::int32_t full_acceleration_16, const Load& load)
    : full_acceleration_16_(full_acceleration_16), load_(load) {}

void Plant::drive(std::int32_t torque) {
    advance(std::int64_t{torque});
}

void Plant::short_circuit() {
    velocity_ -= velocity_ / 4;
    advance(0);
}

void Plant::advance(std::int64_t torque) {
    const std::int64_t inertia = std::max<std::int64_t>(load_.inertia_256, 1);
    const auto speed_change = [&](std::int64_t t) {
        const std::int64_t bounded = std::clamp(t, -kTorqueBound, kTorqueBound);
        return bounded * full_acceleration_16_ * (kCount / 16 * 256) / (kFullTorque * inertia);
    };
    const std::int64_t friction = speed_change(std::max(load_.friction_torque, 0));
    const std::int64_t before = velocity_;
    velocity_ =
        std::clamp(rubbed(velocity_ + speed_change(torque + load_.torque), friction), -kFastest, kFastest);
    position_ += (before + velocity_) / 2;

    const auto hold_at = [&](std::int64_t counts) {
        position_ = counts * kCount;
        velocity_ = 0;
    };
    if (load_.low_stop && position_ < *load_.low_stop * kCount) hold_at(*load_.low_stop);
    if (load_.high_stop && position_ > *load_.high_stop * kCount) hold_at(*load_.high_stop);
}

std::int64_t Plant::counts() const {
    return (position_ + kCount / 2) >> 16;
}

}  // namespace nplc::sim
