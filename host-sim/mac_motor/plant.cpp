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

std::int64_t Plant::inertia() const {
    return std::max<std::int64_t>(load_.inertia_256, 1);
}

std::int64_t Plant::speed_change(std::int64_t torque) const {
    const std::int64_t bounded = std::clamp(torque, -kTorqueBound, kTorqueBound);
    return bounded * full_acceleration_16_ * (kCount / 16 * 256) / (kFullTorque * inertia());
}

void Plant::advance(std::int64_t torque) {
    const std::int64_t friction = speed_change(std::max(load_.friction_torque, 0));
    const std::int64_t before = velocity_;
    velocity_ =
        std::clamp(rubbed(velocity_ + speed_change(torque + load_.torque), friction), -kFastest, kFastest);
    const std::int64_t from = position_;
    position_ += (before + velocity_) / 2;
    if (const MechanicalStop* stop = stop_beyond()) press(*stop, from);
}

/// The stop that the shaft is in, if any.
const MechanicalStop* Plant::stop_beyond() const {
    if (load_.low_stop && position_ < load_.low_stop->counts * kCount) return &*load_.low_stop;
    if (load_.high_stop && position_ > load_.high_stop->counts * kCount) return &*load_.high_stop;
    return nullptr;
}

/// A spring in implicit steps, which no stiffness can set swinging: the velocity is the one that the force at
/// the end of the sample leaves.
void Plant::press(const MechanicalStop& stop, std::int64_t from) {
    const std::int64_t edge = stop.counts * kCount;
    if (stop.spring_1024 <= 0) {
        position_ = edge;
        velocity_ = 0;
        return;
    }
    constexpr std::int64_t kDeepest = std::int64_t{1} << 38;
    constexpr std::int64_t kSteepest = std::int64_t{1} << 33;
    const std::int64_t slope =  // what each count takes off the velocity, 1/65536/1024
        std::min(speed_change(stop.spring_1024), kSteepest);
    const std::int64_t start = std::clamp(from - edge, -kDeepest, kDeepest);
    const std::int64_t push = start / 1024 * slope / kCount;
    velocity_ = std::clamp((velocity_ - push) * 1024 / (1024 + slope / kCount), -kFastest, kFastest);
    if ((velocity_ > 0) != (start + velocity_ > 0)) velocity_ /= 2;  // pushed out, not thrown
    position_ = edge + start + velocity_;
}

std::int64_t Plant::counts() const {
    return (position_ + kCount / 2) >> 16;
}

}  // namespace nplc::sim
