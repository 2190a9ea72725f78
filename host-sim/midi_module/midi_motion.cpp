#include <algorithm>
#include <cstdlib>
#include <optional>

#include "registers/midi_scale.h"
#include "sim/midi_module.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::uint8_t kHardwareStops = 1;
constexpr std::uint8_t kSoftwareStops = 8;
constexpr std::int64_t kDragStep = std::int64_t{midi::kTicksPerSecond} / MidiShaft::kDragSteps;
/// R: braking that the supply cannot take is cut for 5 ms.
constexpr std::int64_t kRelease = std::int64_t{midi::kTicksPerSecond} / 200;

/// 31 bits (003 §IV).
std::int32_t wrapped(std::int64_t position) {
    constexpr std::int64_t kRange = std::int64_t{midi::kMaxPosition} - midi::kMinPosition + 1;
    if (position > midi::kMaxPosition) position -= kRange;
    if (position < midi::kMinPosition) position += kRange;
    return static_cast<std::int32_t>(position);
}

}  // namespace

void MidiModule::schedule(Ticks after) {
    next_step_ = ticks_ + after;
}

void MidiModule::begin_motion(Mode mode, int direction) {
    mode_ = mode;
    direction_ = direction;
    powered_ = true;
    stalled_ = pause_ = false;
    stopped_by_ = 0;
    profile_.clear();
    set_point_ = position_;
}

void MidiModule::go_to(std::int32_t target) {
    begin_motion(Mode::position, target >= position_ ? 1 : -1);
    goal_ = target;
    profile_.begin_move(std::abs(std::int64_t{target} - position_), memory_.period, memory_.ramp);
    if (profile_.running()) schedule(profile_.interval());
}

/// Segments follow each other without a gap; one of no steps takes no time (R).
void MidiModule::next_segment() {
    while (!segments_.empty()) {
        const auto [number, data] = segments_.front();
        segments_.pop();
        const midi::CommandRow& row = *midi::find_command(number);
        const std::int32_t steps = midi::unpack(row.fields[0], data);
        const auto period = static_cast<std::uint16_t>(midi::unpack(row.fields[1], data));
        if (mode_ != Mode::segments) begin_motion(Mode::segments, 1);
        direction_ = steps < 0 ? -1 : 1;
        pause_ = number == midi::PAUSE;
        profile_.begin_segment(std::abs(steps), period);
        if (profile_.running()) return schedule(profile_.interval());
    }
    // R: the position loop holds where the last segment ended.
    if (mode_ == Mode::segments) {
        mode_ = Mode::position;
        goal_ = set_point_;
        end_motion();
    }
}

/// 000 §VI 17h. 003 §IV: catching up is ended by 18h only.
void MidiModule::ramp_down() {
    if ((mode_ != Mode::position && mode_ != Mode::run) || !profile_.running()) return;
    profile_.stop();
    goal_ = wrapped(std::int64_t{set_point_} + direction_ * profile_.remaining());
    if (!profile_.running()) end_motion();
}

/// 000 §VI 18h, and the end-stops: R: at once, with full braking, unless braking is cut. The position loop
/// ends.
void MidiModule::stop_hard() {
    const bool turns = profile_.running() && !pause_ && profile_.last_interval() > 0;
    if (turns) coast_interval_ = profile_.last_interval();
    if (braking_is_cut() && (turns || mode_ == Mode::coast)) {
        mode_ = Mode::coast;
        schedule(coast_interval_);
    } else {
        mode_ = Mode::idle;
        next_step_.reset();
    }
    profile_.clear();
    segments_.clear();
    prepared_.reset();
    armed_ = stalled_ = braking_ = false;
    set_point_ = goal_ = position_;
    remember();
}

/// R: friction stops the shaft at once.
void MidiModule::cut_power() {
    mode_ = Mode::idle;
    profile_.clear();
    segments_.clear();
    next_step_.reset();
    powered_ = stalled_ = braking_ = pause_ = false;
    set_point_ = goal_ = position_;
    remember();
}

void MidiModule::end_motion() {
    braking_ = stalled_ = false;
    if (mode_ == Mode::run) {
        mode_ = Mode::position;
        set_point_ = goal_ = position_;
    }
    next_step_.reset();
    if (adjusts()) schedule(Ticks{memory_.unstall} * midi::kTicksPerLongPeriod);
    remember();
}

/// The place of now becomes 0. R: the target keeps its value in the new coordinates; where that lies behind
/// or too near, the ramp is finished and the rest is made up at unstall speed.
void MidiModule::set_origin() {
    const std::int64_t before = position_;
    position_ = 0;
    set_point_ = wrapped(set_point_ - before);
    if (mode_ == Mode::position && profile_.running()) {
        const std::int64_t left = (std::int64_t{goal_} - set_point_) * direction_;
        profile_.set_remaining(left > 0 ? left : 0);
        if (!profile_.running()) end_motion();
    } else {
        goal_ = wrapped(std::int64_t{goal_} - before);
    }
    remember();
}

bool MidiModule::adjusts() const {
    return powered_ && mode_ == Mode::position && !profile_.running() && position_ != goal_;
}

bool MidiModule::can_turn(int direction) const {
    return powered_ && shaft_.can_turn(direction, torque());
}

/// The supply is gone: the shaft goes on as fast as it is.
void MidiModule::run_out() {
    const bool turns = mode_ == Mode::coast || (profile_.running() && !pause_ && can_turn(direction_));
    const Ticks interval = mode_ == Mode::coast ? coast_interval_ : profile_.last_interval();
    if (!turns || interval <= 0) return;
    shaft_.let_go(direction_ * std::int64_t{midi::kTicksPerSecond} / interval);
    if (!next_drag_) next_drag_ = ticks_ + kDragStep;
}

void MidiModule::set_load(std::int32_t torque) {
    shaft_.set_load(torque);
    if (shaft_.slips() && !next_drag_) next_drag_ = ticks_ + kDragStep;
}

void MidiModule::drag() {
    std::int32_t by = 0;
    if (mode_ == Mode::coast) {
        shaft_.stand();
    } else {
        by = shaft_.drag(powered_ ? std::optional<std::int32_t>(torque()) : std::nullopt);
    }
    if (shaft_.slips()) next_drag_ = ticks_ + kDragStep;
    if (by != 0) turn_shaft(by);
}

void MidiModule::turn_shaft(std::int32_t increments) {
    const std::int32_t moved = shaft_.turn_by(increments);
    if (!on_) return;
    position_ = wrapped(std::int64_t{position_} + moved);
    if (mode_ == Mode::idle) set_point_ = goal_ = position_;
    if (adjusts() && !next_step_) schedule(Ticks{memory_.unstall} * midi::kTicksPerLongPeriod);
    if (!moving()) remember();
}

bool MidiModule::is_over_release(std::int32_t millivolts) const {
    const std::int64_t limit = std::int64_t{midi::facts_of(model_).max_supply} * midi::kReleasePercent;
    return std::int64_t{millivolts} * 100 > limit;
}

bool MidiModule::braking_is_cut() const {
    return is_over_release(supply_) || ticks_ < release_until_;
}

/// 003 §IV: each end-stop ends motion in its own direction only. R: a software stop acts beyond its position.
bool MidiModule::blocked(int direction) {
    std::uint32_t by = 0;
    if ((memory_.stops & kHardwareStops) != 0) {
        if (direction > 0 && input(Input::upper_stop)) by |= midi::kAtUpperInput;
        if (direction < 0 && input(Input::lower_stop)) by |= midi::kAtLowerInput;
    }
    if ((memory_.stops & kSoftwareStops) != 0) {
        if (direction > 0 && position_ > memory_.upper_stop) by |= midi::kAtUpperStop;
        if (direction < 0 && position_ < memory_.lower_stop) by |= midi::kAtLowerStop;
    }
    stopped_by_ |= by;
    return by != 0;
}

void MidiModule::turn(int direction) {
    position_ = wrapped(std::int64_t{position_} + direction);
    shaft_.turn(direction);
}

void MidiModule::step() {
    if (mode_ == Mode::coast) {
        if (!braking_is_cut()) return stop_hard();
        if (!shaft_.at_end(direction_)) turn(direction_);
        set_point_ = goal_ = position_;
        return schedule(coast_interval_);
    }
    if (profile_.running()) return step_profile();
    if (adjusts()) step_adjusting();
}

void MidiModule::step_profile() {
    if (!pause_ && blocked(direction_)) return stop_hard();
    if (!pause_) {
        set_point_ = wrapped(std::int64_t{set_point_} + direction_);
        const bool follows = can_turn(direction_);
        stalled_ = !follows;
        if (follows) turn(direction_);
        if (!follows && mode_ == Mode::run) set_point_ = position_;
    }
    if (!pause_ && profile_.slows() && !brake()) return;
    profile_.advance();
    if (!profile_.slows()) braking_ = false;
    if (profile_.running()) return schedule(profile_.interval());
    if (mode_ == Mode::segments) return next_segment();
    end_motion();
}

/// False: braking is cut. The shaft goes on as it was; what is too far is made up at unstall speed.
bool MidiModule::brake() {
    braking_ = !braking_is_cut();
    check_supply();
    if (!powered_) return false;
    // R: 5 ms without braking, then 5 ms with it, as long as braking lifts the supply too high.
    if (is_over_release(supply()) && ticks_ >= release_until_ + kRelease) {
        release_until_ = ticks_ + kRelease;
        braking_ = false;
    }
    if (!braking_) schedule(profile_.last_interval());
    return braking_;
}

void MidiModule::step_adjusting() {
    const int direction = goal_ > position_ ? 1 : -1;
    if (blocked(direction)) return stop_hard();
    if (can_turn(direction)) turn(direction);
    if (adjusts()) return schedule(Ticks{memory_.unstall} * midi::kTicksPerLongPeriod);
    remember();
}

}  // namespace nplc::sim
