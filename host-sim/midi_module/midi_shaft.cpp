#include "sim/midi_shaft.h"

#include <algorithm>
#include <cstdlib>

namespace nplc::sim {
namespace {

/// R: friction as a share of the holding torque, as for the virtual JVL motors; slows down a coasting shaft.
constexpr std::int64_t kFriction = 5, kWhole = 1'023;

}  // namespace

bool MidiShaft::at_end(int direction) const {
    return direction > 0 ? high_ && turned_ >= *high_ : low_ && turned_ <= *low_;
}

bool MidiShaft::can_turn(int direction, std::int32_t torque) const {
    return !held_ && !at_end(direction) && torque > std::abs(load_);
}

void MidiShaft::stop(bool above, std::int64_t at) {
    (above ? high_ : low_) = above ? std::max(at, turned_) : std::min(at, turned_);
}

std::int32_t MidiShaft::turn_by(std::int32_t increments) {
    const std::int64_t wanted = turned_ + increments;
    std::int64_t to = wanted;
    if (high_) to = std::min(to, *high_);
    if (low_) to = std::max(to, *low_);
    if (to != wanted) stand();
    const auto moved = static_cast<std::int32_t>(to - turned_);
    turned_ = to;
    return moved;
}

void MidiShaft::let_go(std::int64_t increments_per_second) {
    speed_ = increments_per_second * kFraction / kDragSteps;
    rest_ = 0;
}

/// 003 §III and §VII 19h: at rest the holding torque is TORQUE's share, half of it in standby, none with
/// power off. R: the torque beyond that accelerates the shaft; a shaft that is held again stops at once.
std::int32_t MidiShaft::drag(std::optional<std::int32_t> torque) {
    const std::int32_t beyond = std::abs(load_) - torque.value_or(0);
    if (held_ || (torque && beyond <= 0)) {
        stand();
    } else if (load_ == 0) {
        slow_down();
    } else {
        const std::int64_t gain = full_acceleration_ * beyond * kFraction / imax_ / kDragSteps / kDragSteps;
        speed_ = std::clamp(speed_ + (load_ > 0 ? gain : -gain), -fastest_, fastest_);
    }
    rest_ += speed_;
    const std::int64_t whole = rest_ / kFraction;
    rest_ -= whole * kFraction;
    return static_cast<std::int32_t>(whole);
}

void MidiShaft::slow_down() {
    const std::int64_t loss = full_acceleration_ * kFriction * kFraction / kWhole / kDragSteps / kDragSteps;
    speed_ = speed_ > 0 ? std::max<std::int64_t>(speed_ - loss, 0) : std::min<std::int64_t>(speed_ + loss, 0);
}

}  // namespace nplc::sim
