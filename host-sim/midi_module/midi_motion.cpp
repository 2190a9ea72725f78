#include "sim/midi_motion.h"

#include <algorithm>
#include <cstdlib>

#include "registers/midi_scale.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int64_t kDragStep = std::int64_t{midi::kTicksPerSecond} / MidiShaft::kDragSteps;

/// 31 bits (003 §IV).
std::int32_t wrapped(std::int64_t position) {
    constexpr std::int64_t kRange = std::int64_t{midi::kMaxPosition} - midi::kMinPosition + 1;
    if (position > midi::kMaxPosition) position -= kRange;
    if (position < midi::kMinPosition) position += kRange;
    return static_cast<std::int32_t>(position);
}

}  // namespace

bool MidiMotion::advance(Ticks until) {
    const bool drags = next_drag_ && *next_drag_ <= until && !(next_step_ && *next_step_ < *next_drag_);
    std::optional<Ticks>& next = drags ? next_drag_ : next_step_;
    const bool is_due = next && *next <= until;
    ticks_ = std::max(ticks_, is_due ? *next : until);
    if (!is_due) return false;
    next.reset();
    drags ? drag() : step();
    return true;
}

void MidiMotion::schedule_adjusting() {
    schedule(Ticks{eeprom_.values.unstall} * midi::kTicksPerLongPeriod);
}

void MidiMotion::begin(Mode mode, int direction) {
    mode_ = mode;
    direction_ = direction;
    powered_ = true;
    stalled_ = pause_ = false;
    stopped_by_ = 0;
    profile_.clear();
    set_point_ = position_;
}

void MidiMotion::go_to(std::int32_t target) {
    begin(Mode::position, target >= position_ ? 1 : -1);
    goal_ = target;
    profile_.begin_move(std::abs(std::int64_t{target} - position_), eeprom_.values.period,
                        eeprom_.values.ramp);
    if (profile_.running()) schedule(profile_.interval());
}

/// Segments follow each other without a gap; one with no steps takes no time (R).
void MidiMotion::next_segment() {
    while (!segments_.empty()) {
        const auto [number, data] = segments_.front();
        segments_.pop();
        const midi::CommandRow& row = *midi::find_command(number);
        const std::int32_t steps = midi::unpack(row.fields[0], data);
        const auto period = static_cast<std::uint16_t>(midi::unpack(row.fields[1], data));
        if (mode_ != Mode::segments) begin(Mode::segments, 1);
        direction_ = steps < 0 ? -1 : 1;
        pause_ = number == midi::PAUSE;
        profile_.begin_segment(std::abs(steps), period);
        if (profile_.running()) return schedule(profile_.interval());
    }
    // R: the position loop holds where the last segment ended.
    if (mode_ == Mode::segments) {
        mode_ = Mode::position;
        goal_ = set_point_;
        end();
    }
}

/// 000 §VI 15h. R: refused during other motions.
bool MidiMotion::run(int direction, std::uint16_t period) {
    const bool running = mode_ == Mode::run && profile_.running();
    if (moving() && !running) return false;
    if (period == 0) {
        ramp_down();
        return true;
    }
    if (!running) begin(Mode::run, direction);
    profile_.begin_run(period, eeprom_.values.ramp);
    if (!running) schedule(profile_.interval());
    return true;
}

/// 000 §VI 16h, 1Eh. R: refused during other motions.
bool MidiMotion::add_segment(const Segment& segment) {
    const bool running = follows_segments();
    if (moving() && !running) return false;
    if (!segments_.push(segment)) return false;
    if (!running) next_segment();
    return true;
}

/// 000 §VI 17h. 003 §IV: catching up is ended by 18h only.
void MidiMotion::ramp_down() {
    if ((mode_ != Mode::position && mode_ != Mode::run) || !profile_.running()) return;
    profile_.stop();
    goal_ = wrapped(std::int64_t{set_point_} + direction_ * profile_.remaining());
    if (!profile_.running()) end();
}

/// 000 §VI 18h, and the end-stops: R: at once, with full braking, unless braking is cut. The position loop
/// ends.
void MidiMotion::stop_hard() {
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
    stalled_ = false;
    supply_.brake(false);
    set_point_ = goal_ = position_;
    remember();
    events_.on_hard_stop();
}

/// R: friction stops the shaft at once.
void MidiMotion::cut_power() {
    mode_ = Mode::idle;
    profile_.clear();
    segments_.clear();
    next_step_.reset();
    powered_ = stalled_ = pause_ = false;
    supply_.brake(false);
    set_point_ = goal_ = position_;
    remember();
}

void MidiMotion::end() {
    stalled_ = false;
    supply_.brake(false);
    if (mode_ == Mode::run) {
        mode_ = Mode::position;
        set_point_ = goal_ = position_;
    }
    next_step_.reset();
    if (adjusts()) schedule_adjusting();
    remember();
}

/// The present position becomes 0. R: the target keeps its value in the new coordinates; if it is then behind
/// or too near, the ramp is finished and the rest is moved at unstall speed.
void MidiMotion::set_origin() {
    const std::int64_t before = position_;
    position_ = 0;
    set_point_ = wrapped(set_point_ - before);
    if (mode_ == Mode::position && profile_.running()) {
        const std::int64_t left = (std::int64_t{goal_} - set_point_) * direction_;
        profile_.set_remaining(left > 0 ? left : 0);
        if (!profile_.running()) end();
    } else {
        goal_ = wrapped(std::int64_t{goal_} - before);
    }
    remember();
}

bool MidiMotion::moving() const {
    if (mode_ == Mode::coast || profile_.running()) return true;
    return busy() && adjusts();
}

std::uint8_t MidiMotion::torque() const {
    if (!powered_) return 0;
    return eeprom_.values.standby && !moving() ? static_cast<std::uint8_t>(eeprom_.values.torque / 2)
                                               : eeprom_.values.torque;
}

bool MidiMotion::busy() const {
    if (!supply_.is_on() || !powered_) return false;
    if (mode_ == Mode::run) return stalled_;
    if (mode_ == Mode::segments) return std::abs(position_ - set_point_) > eeprom_.values.tolerance;
    return mode_ == Mode::position && std::abs(position_ - goal_) > eeprom_.values.tolerance;
}

bool MidiMotion::adjusts() const {
    return powered_ && mode_ == Mode::position && !profile_.running() && position_ != goal_;
}

bool MidiMotion::can_turn(int direction) const {
    return powered_ && shaft_.can_turn(direction, torque());
}

/// The supply is off: the shaft coasts at its present speed.
void MidiMotion::run_out() {
    const bool turns = mode_ == Mode::coast || (profile_.running() && !pause_ && can_turn(direction_));
    const Ticks interval = mode_ == Mode::coast ? coast_interval_ : profile_.last_interval();
    if (!turns || interval <= 0) return;
    shaft_.let_go(direction_ * std::int64_t{midi::kTicksPerSecond} / interval);
    if (!next_drag_) next_drag_ = ticks_ + kDragStep;
}

void MidiMotion::set_load(std::int32_t torque) {
    shaft_.set_load(torque);
    if (shaft_.slips() && !next_drag_) next_drag_ = ticks_ + kDragStep;
}

void MidiMotion::drag() {
    std::int32_t by = 0;
    if (mode_ == Mode::coast) {
        shaft_.stand();
    } else {
        by = shaft_.drag(powered_ ? std::optional<std::int32_t>(torque()) : std::nullopt);
    }
    if (shaft_.slips()) next_drag_ = ticks_ + kDragStep;
    if (by != 0) turn_shaft(by);
}

void MidiMotion::turn_shaft(std::int32_t increments) {
    const std::int32_t moved = shaft_.turn_by(increments);
    if (!supply_.is_on()) return;
    position_ = wrapped(std::int64_t{position_} + moved);
    if (mode_ == Mode::idle) set_point_ = goal_ = position_;
    if (adjusts() && !next_step_) schedule_adjusting();
    if (!moving()) remember();
}

/// 003 §IV: each end-stop ends motion in its own direction only. R: a software stop acts beyond its position.
bool MidiMotion::blocked(int direction) {
    std::uint32_t by = 0;
    if ((eeprom_.values.stops & MidiMemory::kHardwareStops) != 0) {
        if (direction > 0 && inputs_[MidiInput::upper_stop]) by |= midi::kAtUpperInput;
        if (direction < 0 && inputs_[MidiInput::lower_stop]) by |= midi::kAtLowerInput;
    }
    if ((eeprom_.values.stops & MidiMemory::kSoftwareStops) != 0) {
        if (direction > 0 && position_ > eeprom_.values.upper_stop) by |= midi::kAtUpperStop;
        if (direction < 0 && position_ < eeprom_.values.lower_stop) by |= midi::kAtLowerStop;
    }
    stopped_by_ |= by;
    return by != 0;
}

void MidiMotion::turn(int direction) {
    position_ = wrapped(std::int64_t{position_} + direction);
    shaft_.turn(direction);
}

void MidiMotion::step() {
    if (mode_ == Mode::coast) {
        if (!braking_is_cut()) return stop_hard();
        if (!shaft_.at_end(direction_)) turn(direction_);
        set_point_ = goal_ = position_;
        return schedule(coast_interval_);
    }
    if (profile_.running()) return step_profile();
    if (adjusts()) step_adjusting();
}

void MidiMotion::step_profile() {
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
    if (!profile_.slows()) supply_.brake(false);
    if (profile_.running()) return schedule(profile_.interval());
    if (mode_ == Mode::segments) return next_segment();
    end();
}

/// False: braking is cut. The shaft coasts; the excess distance is moved back at unstall speed.
bool MidiMotion::brake() {
    supply_.brake(!braking_is_cut());
    events_.on_braking();
    if (!powered_) return false;
    supply_.cut_excess(ticks_);
    if (!supply_.brakes()) schedule(profile_.last_interval());
    return supply_.brakes();
}

void MidiMotion::step_adjusting() {
    const int direction = goal_ > position_ ? 1 : -1;
    if (blocked(direction)) return stop_hard();
    if (can_turn(direction)) turn(direction);
    if (adjusts()) return schedule_adjusting();
    remember();
}

}  // namespace nplc::sim
