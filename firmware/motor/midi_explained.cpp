// Whether the motion explains the positions that are read while it goes on.
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "motor/midi_motor.h"
#include "registers/midi_scale.h"

namespace nplc::motor {
namespace {

constexpr std::uint32_t kPeriodsPerMicrosecond = 8;
/// The fastest that it catches up with.
constexpr std::uint32_t kCatchUp = registers::midi::kTicksPerLongPeriod;
/// Increments, of a shaft that gives way, swings or is pushed: 18 degrees of a MAC34, 90 of a MAC23.
constexpr std::int32_t kSlack = 500;

}  // namespace

/// The module takes its position between question and answer: the time from the last question on is the
/// longest that can lie between two positions. (By itself in on_position() it would take 100 bytes more.)
[[gnu::noinline]] bool MidiMotor::is_explained(base::Instant now) {
    const std::uint32_t asked_before = std::exchange(position_asked_at_, asked_at_);
    const bool runs = motion_ == Motion::running && at_speed_;
    const bool was_watched = std::exchange(watched_, runs || motion_ == Motion::going);
    if (!was_watched || !watched_) return true;
    const std::uint32_t time = static_cast<std::uint32_t>(now.time_since_epoch().count()) - asked_before;
    const std::uint32_t period = std::clamp<std::uint32_t>(runs ? run_period_ : period_, 1, kCatchUp);
    const auto travel = static_cast<std::int32_t>(time * kPeriodsPerMicrosecond / period) + kSlack;
    auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(position_) -
                                           static_cast<std::uint32_t>(position_before_));
    if (runs ? left_ : goal_ < position_before_) moved = -moved;
    return (moved <= travel && moved >= -kSlack) || (referenced_ != 0 && std::abs(position_) <= travel);
}

}  // namespace nplc::motor
