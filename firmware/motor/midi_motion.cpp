#include "motor/midi_motion.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "registers/midi_scale.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;

/// Time limit of a stop beyond the ramp time.
constexpr base::Microseconds kStopLate{500'000};
constexpr base::Microseconds kSurely{20'000};
constexpr base::Microseconds kSwing{1'000'000};
constexpr std::int32_t kStandby =
    5;  ///< increments by which a shaft at standstill may oscillate (003 §VII 02h)
constexpr std::uint32_t kPeriodsPerMicrosecond = 8;
/// The highest speed of catching up.
constexpr std::uint32_t kCatchUp = midi::kTicksPerLongPeriod;
/// Tolerance in increments for a shaft that yields, oscillates or is pushed: 18 degrees of a MAC34, 90 of a
/// MAC23.
constexpr std::int32_t kSlack = 500;

/// 240 x AA periods of 0.125 us (R: each of the ramp's 15 steps takes the same time).
constexpr base::Microseconds ramp_time(std::uint8_t ramp, std::uint16_t period) {
    return base::Microseconds(std::uint32_t{30} * ramp * period);
}

/// Modulo 2^32, as the module counts.
constexpr bool is_near(std::int32_t a, std::int32_t b, std::int32_t slack) {
    const auto most = static_cast<std::uint32_t>(slack);
    return static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b) + most <= 2 * most;
}

}  // namespace

void MidiMotion::begin(State state) {
    state_ = state;
    doubtful_ = watched_ = arrived_ = at_speed_ = goal_holds_ = false;
}

void MidiMotion::begin_move(std::int32_t goal) {
    begin(State::going);
    goal_ = goal;
    goal_holds_ = true;
}

void MidiMotion::begin_run(std::uint32_t run, const MidiDrive& drive, base::Instant now) {
    begin(State::running);
    run_period_ = static_cast<std::uint16_t>(run);
    left_ = run >> 16 == midi::kTurnsLeft;
    ramp_end_ = now + ramp_time(drive.ramp(), run_period_);
}

/// 003 §IV: catching up is ended by 18h only, so a stop gets a time limit after which EMERGENCY_STOP follows.
void MidiMotion::begin_stop(const MidiDrive& drive, base::Instant now) {
    goal_holds_ = arrived_ = at_speed_ = doubtful_ = seen_moving_ = false;
    if (!at_rest()) state_ = State::stopping;
    ramp_end_ = now + ramp_time(drive.ramp(), std::max(run_period_, drive.period())) + kStopLate;
}

void MidiMotion::wait_for_rest(base::Instant at_least) {
    ramp_end_ = std::max(ramp_end_, at_least);
    state_ = State::stopping;
    steady_begun_ = goal_holds_ = false;
}

void MidiMotion::restart() {
    forget();
    arrived_ = measured_ = false;
}

void MidiMotion::forget() {
    state_ = State::unknown;
    steady_begun_ = seen_moving_ = false;
}

void MidiMotion::end_by_trip() {
    state_ = State::at_rest;
    forget_goal();
}

void MidiMotion::check_again(std::int32_t goal) {
    if (!at_rest() || !holds(goal)) return;
    state_ = State::going;
    arrived_ = measured_ = false;
}

[[gnu::noinline]] void MidiMotion::on_measures(const MidiDrive& drive, base::Instant now) {
    measured_ = true;
    if (drive.is_busy() && moves()) doubtful_ = false;
    if (state_ == State::running) at_speed_ = !drive.is_busy() && !doubtful_ && now >= ramp_end_;
    if (at_rest() && goal_holds_ && drive.is_busy()) {
        state_ = State::going;
        arrived_ = false;
    }
}

bool MidiMotion::needs_position(const MidiDrive& drive) const {
    if (at_rest()) return arrived_ && goal_holds_;
    return state_ != State::going || has_ended(drive);
}

/// Not busy according to measures that are newer than the motion's command.
bool MidiMotion::has_ended(const MidiDrive& drive) const {
    return measured_ && !drive.is_busy();
}

MidiMotion::Event MidiMotion::on_position(const MidiDrive& drive, std::uint32_t asked_at, base::Instant now) {
    if (!is_explained(drive, asked_at, now)) return Event::jumped;
    if (state_ == State::going && has_ended(drive) && goal_holds_ && is_within(drive, drive.tolerance())) {
        state_ = State::at_rest;
        arrived_ = true;
        doubtful_ = false;
        return Event::none;
    }
    if (at_rest()) {
        check_still_there(drive);
        return Event::none;
    }
    return needs_position(drive) ? check_steady(drive, now) : Event::none;
}

/// The module samples its position between query and answer: the time since the previous query was sent is
/// the longest that can lie between two positions.
bool MidiMotion::is_explained(const MidiDrive& drive, std::uint32_t asked_at, base::Instant now) {
    const std::uint32_t asked_before = std::exchange(position_asked_at_, asked_at);
    const bool runs = at_speed();
    const bool was_watched = std::exchange(watched_, runs || state_ == State::going);
    if (!was_watched || !watched_) return true;
    const std::uint32_t time = static_cast<std::uint32_t>(now.time_since_epoch().count()) - asked_before;
    const std::uint32_t period = std::clamp<std::uint32_t>(runs ? run_period_ : drive.period(), 1, kCatchUp);
    const auto travel = static_cast<std::int32_t>(time * kPeriodsPerMicrosecond / period) + kSlack;
    std::int32_t moved = drive.moved();
    if (runs ? left_ : goal_ < drive.position_before()) moved = -moved;
    return (moved <= travel && moved >= -kSlack) ||
           (drive.was_referenced() && std::abs(drive.position()) <= travel);
}

bool MidiMotion::is_within(const MidiDrive& drive, std::int32_t slack) const {
    return is_near(drive.position(), goal_, slack);
}

/// Another master's move may have been too short to be reported as busy.
void MidiMotion::check_still_there(const MidiDrive& drive) {
    if (!arrived_ || !goal_holds_ || is_within(drive, std::max<std::int32_t>(drive.tolerance(), kStandby)))
        return;
    state_ = State::going;
    arrived_ = measured_ = false;
}

/// Increments by which a shaft at standstill may move.
std::int32_t MidiMotion::slack() const {
    return state_ == State::running ? 0 : kStandby;
}

/// Long enough for one increment more than the slack at the lowest speed of a ramp or of catching up. A shaft
/// that oscillates in standby is within the tolerance only at times.
base::Microseconds MidiMotion::steady_time(const MidiDrive& drive) const {
    if (state_ == State::going && goal_holds_ && is_within(drive, kStandby)) return kSwing;
    const std::int32_t slowest = std::max<std::int32_t>(2 * std::max(run_period_, drive.period()),
                                                        200 * std::int32_t{drive.unstall()});
    return base::Microseconds((slack() + 1) * slowest) + kSurely;
}

[[gnu::noinline]] MidiMotion::Event MidiMotion::check_steady(const MidiDrive& drive, base::Instant now) {
    if (!steady_begun_ || !is_near(drive.position(), steady_position_, slack())) {
        if (steady_begun_ && state_ == State::running) doubtful_ = false;
        if (steady_begun_ && state_ == State::unknown) seen_moving_ = true;
        steady_begun_ = true;
        steady_position_ = drive.position();
        steady_since_ = now;
    } else if (now - steady_since_ >= steady_time(drive)) {
        steady_begun_ = false;
        return conclude(drive);
    }
    return Event::none;
}

/// Called at standstill: determines how the motion ended.
MidiMotion::Event MidiMotion::conclude(const MidiDrive& drive) {
    const State ended = state_;
    if (ended == State::running && !has_ended(drive))
        return Event::none;  // held back, and the module keeps trying
    state_ = State::at_rest;
    run_period_ = 0;
    const bool expected = ended == State::running || (ended == State::going && goal_holds_);
    if (!expected) return Event::none;
    goal_holds_ = false;
    if (std::exchange(doubtful_, false)) return Event::not_taken;
    return drive.at_end_stop() ? Event::end_stop : Event::not_arrived;
}

}  // namespace nplc::motor
