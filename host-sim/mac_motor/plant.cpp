#include "sim/plant.h"

#include <algorithm>

#include "sim/drive.h"

namespace nplc::sim {
namespace {

constexpr double kFastest = 4096;  // counts/sample, 31,250 rpm on MAC50-141: keeps a wild load in range
constexpr std::int64_t kFarthest = std::int64_t{1} << 42;  // counts

/// Halves in an outer sample: the 15th root of 1/2.
double thrown_in(int steps) {
    return steps == 1 ? 0.5 : 0.9548;
}

std::int64_t edge_of(const MechanicalStop& stop) {
    return std::clamp(stop.counts, -kFarthest, kFarthest);
}

}  // namespace

Plant::Plant(double full_acceleration, int steps, const Load& load, double elsewhere)
    : acceleration_of_one_(full_acceleration / kFullTorque / steps / steps),
      elsewhere_256_(256 * elsewhere),
      fastest_(kFastest / steps),
      slow_(kSlow / steps),
      thrown_(thrown_in(steps)),
      load_(load) {
    take_load();
}

void Plant::keep_within_stops(std::int64_t from) {
    if (const MechanicalStop* stop = stop_beyond()) press(*stop, from);
}

/// The stop that the shaft is in, if any.
const MechanicalStop* Plant::stop_beyond() const {
    if (load_.low_stop && position_ < edge_of(*load_.low_stop) * kCount) return &*load_.low_stop;
    if (load_.high_stop && position_ > edge_of(*load_.high_stop) * kCount) return &*load_.high_stop;
    return nullptr;
}

/// A spring in implicit steps, which no stiffness can set swinging: the velocity is the one that the force at
/// the end of the step leaves.
void Plant::press(const MechanicalStop& stop, std::int64_t from) {
    const std::int64_t edge = edge_of(stop) * kCount;
    if (stop.spring_1024 <= 0) {
        position_ = edge;
        velocity_ = 0;
        return;
    }
    constexpr double kSteepest = 128;
    const double torque = std::min(static_cast<double>(stop.spring_1024) / 1024, kTorqueBound);
    const double slope = std::min(torque * of_one_, kSteepest);
    const double depth = static_cast<double>(from - edge) / static_cast<double>(kCount);
    velocity_ = std::clamp((velocity_ - depth * slope) / (1 + slope), -fastest_, fastest_);
    if ((velocity_ > 0) != (depth + velocity_ > 0)) velocity_ *= thrown_;  // pushed out, not thrown
    position_ = from + static_cast<std::int64_t>(velocity_ * static_cast<double>(kCount));
}

}  // namespace nplc::sim
