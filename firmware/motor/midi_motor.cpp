#include "motor/midi_motor.h"

#include <algorithm>
#include <utility>

namespace nplc::motor {
namespace {

namespace midi = registers::midi;
using Kind = MidiOutcome::Kind;

constexpr base::Microseconds kRetry{20'000};
/// Between two messages while nobody answers.
constexpr base::Microseconds kProbe{100'000};
constexpr std::uint8_t kMostRefusals = 50;  ///< of a command that waits for standstill
/// With a motion that nobody knows of; then it is ended.
constexpr base::Microseconds kPatience{1'000'000};
/// 000 §VI 00h: two seconds, and a little.
constexpr base::Microseconds kDeaf{2'100'000};
/// While answers cannot be read.
constexpr std::uint8_t kBlindStops = 3;
/// Beyond the ramp's own time.
constexpr base::Microseconds kStopLate{500'000};

constexpr MidiMessage query(midi::Query number) {
    return {.is_query = true, .number = number};
}

/// 240 x AA periods of 0.125 us (R: the ramp's 15 steps take as long each).
constexpr base::Microseconds ramp_time(std::uint8_t ramp, std::uint16_t period) {
    return base::Microseconds(std::uint32_t{30} * ramp * period);
}

}  // namespace

MidiMotor::MidiMotor(MidiLink& link, const Settings& settings) : link_(link), model_(settings.model) {}

void MidiMotor::poll(base::Instant now) {
    const MidiOutcome outcome = link_.poll(now);
    if (outcome.kind != Kind::none) on_outcome(outcome, now);
    if (link_.take_boot()) on_boot(now);
    look_for_trouble(now);
    work(now);
}

base::Instant MidiMotor::next_poll(base::Instant now) const {
    if (link_.busy()) return link_.next_poll(now);
    base::Instant next = link_.next_poll(now);
    if (phase_ == Phase::resetting) return std::min(next, deaf_until_);
    if (phase_ != Phase::down && (phase_ != Phase::up || has_work())) return now;
    next = std::min(next, next_query_);
    if (phase_ == Phase::up && refusals_ != 0 && retry_at_ > now) next = std::min(next, retry_at_);
    if (phase_ == Phase::up && motion_ == Motion::stopping) next = std::min(next, std::max(now, ramp_end_));
    return next;
}

bool MidiMotor::has_work() const {
    return resync_ || stop_wanted_ || reset_wanted_ || zero_wanted_ || base_ != 0 || order_open_ ||
           !orders_.empty() || !status_is_new_ || doubtful_ || is_open(access_state_);
}

void MidiMotor::work(base::Instant now) {
    if (link_.busy()) return;
    const Message message = next_message(now);
    if (!message) return;
    message_ = *message;
    asked_at_ = static_cast<std::uint32_t>(now.time_since_epoch().count());
    link_.begin(message_, now);
}

MidiMotor::Message MidiMotor::next_message(base::Instant now) {
    if (phase_ == Phase::down) {
        if (now < next_query_) return {};
        next_query_ = now + kProbe;
        if (blind_stops_ == 0) return query(midi::GET_STATUS);
        --blind_stops_;
        return MidiMessage{.number = midi::EMERGENCY_STOP};
    }
    if (phase_ != Phase::up) {
        if (phase_ == Phase::resetting && now >= deaf_until_) phase_ = Phase::status;
        return start_up_query();
    }
    if (resync_) return query(midi::GET_STATUS);
    for (;;) {
        if (const Message command = next_command(now)) return command;
        if (zero_unclear_ || base_ != 0) return query(midi::GET_POSITION);
        if (doubtful_) return next_query(now);
        if (std::exchange(order_open_, false)) ++counters_.orders;
        if (orders_.empty()) break;
        const Order order = orders_.front();
        orders_.pop();
        order_open_ = true;
        execute(order);
    }
    if (!status_is_new_) return query(midi::GET_STATUS);
    if (const Message access = serve_access()) return access;
    return next_query(now);
}

MidiMotor::Message MidiMotor::start_up_query() const {
    switch (phase_) {
        case Phase::status:
            return query(midi::GET_STATUS);
        case Phase::imax:
            return MidiMessage{.is_query = true, .number = midi::GET_RAM, .sub_index = midi::kImaxAddress};
        case Phase::speeds:
            return query(midi::GET_SPEEDS);
        case Phase::settings:
            return query(midi::GET_SETTINGS);
        case Phase::position:
            return query(midi::GET_POSITION);
        case Phase::down:
        case Phase::up:
        case Phase::resetting:
            break;
    }
    return {};
}

MidiMotor::Message MidiMotor::next_query(base::Instant now) {
    if (!doubtful_ && now < next_query_) return {};
    turn_ = static_cast<std::uint8_t>(turn_ == 2 ? 0 : turn_ + 1);
    if (turn_ == 2 && (moves() || needs_position())) return query(midi::GET_POSITION);
    if (turn_ == 2) turn_ = 0;
    return query(turn_ == 0 ? midi::GET_STATUS : midi::GET_MEASURES);
}

/// R: it says so on CAN only; on a serial line its two deaf seconds tell.
void MidiMotor::on_boot(base::Instant now) {
    if (phase_ == Phase::resetting) {
        deaf_until_ = now;
    } else if (phase_ == Phase::down) {
        next_query_ = now;
    } else {
        lose_link(MidiFault::restarted, now);
        next_query_ = now;
    }
}

/// Both drives obey the stop, and where answers come damaged the requests may be understood.
void MidiMotor::look_for_trouble(base::Instant now) {
    const MidiTrouble trouble = link_.trouble();
    if (trouble == MidiTrouble::none) return;
    const bool down = phase_ == Phase::down;
    if (trouble == MidiTrouble::no_bus) return down ? void() : lose_link(MidiFault::link_lost, now);
    if (down && fault_ == MidiFault::several) return;
    was_up_ = true;  // told of at a start too, and before what is not acknowledged yet
    fault_ = MidiFault::none;
    lose_link(MidiFault::several, now);
}

void MidiMotor::drop_orders() {
    counters_.discarded += static_cast<std::uint32_t>(orders_.size()) + (order_open_ ? 1U : 0U);
    orders_.clear();
    order_open_ = false;
    link_.withdraw();
}

void MidiMotor::lose_link(MidiFault why, base::Instant now) {
    drop_orders();
    if (was_up_) {
        raise(why);
        link_error_ = true;
        ++counters_.link_losses;
    }
    if (is_open(access_state_)) end_access(AccessState::failed);
    was_up_ = resetting_ = reset_wanted_ = resync_ = doubtful_ = goal_holds_ = false;
    phase_ = Phase::down;
    failures_ = repeats_ = refusals_ = 0;
    next_query_ = now + kProbe;
    ignore_ = link_.busy();
    if (why == MidiFault::link_lost || why == MidiFault::restarted) return;
    blind_stops_ = kBlindStops;
    next_query_ = now;
}

void MidiMotor::on_outcome(const MidiOutcome& outcome, base::Instant now) {
    if (std::exchange(ignore_, false)) return;
    // A probe: its answer counts as soon as only one module gives it.
    if (phase_ == Phase::down) {
        probe_ = outcome;
        if (outcome.kind != Kind::value || link_.trouble() != MidiTrouble::none) return;
    }
    switch (outcome.kind) {
        case Kind::none:
            return;
        case Kind::accepted:
            failures_ = 0;
            return on_accepted(now);
        case Kind::value:
            failures_ = 0;
            return on_value(outcome.value, now);
        case Kind::refused:
            if (!message_.is_query || phase_ == Phase::imax) return on_refused(now);
            [[fallthrough]];
        case Kind::not_taken:
        case Kind::unclear:
            if (++failures_ >= kMostRepeats)
                return lose_link(outcome.damaged ? MidiFault::unreadable : MidiFault::link_lost, now);
            if (outcome.kind != Kind::not_taken) return on_unclear(now);
            ++counters_.resent;
    }
}

/// Parameters and stops may be sent again. A motion is asked after; a change of a run's speed and a new
/// origin in mid-motion leave no trace that could be.
void MidiMotor::on_unclear(base::Instant now) {
    resync_ = phase_ == Phase::up;
    if (message_.is_query) return;
    const bool in_run = message_.number == midi::RUN && motion_ == Motion::running;
    const bool moved_origin = message_.number == midi::ZERO_POSITION && motion_ != Motion::at_rest;
    if (in_run || moved_origin || ++repeats_ > kMostRepeats) {
        forget_parameter();
        raise(MidiFault::unclear);
        stop_wanted_ = true;
    } else if (message_.number == midi::ZERO_POSITION) {
        zero_unclear_ = true;
        watched_ = false;
    } else if (message_.number == midi::RESET) {
        begin_reset(now);
    } else if (message_.number == midi::GO_TO || message_.number == midi::RUN) {
        const std::uint8_t repeats = repeats_;
        on_accepted(now);
        repeats_ = repeats;
        doubtful_ = true;
    } else {
        ++counters_.resent;
    }
}

void MidiMotor::on_refused(base::Instant now) {
    if (phase_ == Phase::imax) {
        failures_ = 0;
        phase_ = Phase::speeds;  // 80h stays
        return;
    }
    failures_ = 0;
    status_is_new_ = false;
    switch (message_.number) {
        case midi::GO_TO:
        case midi::RUN:
        case midi::SPEED:
        case midi::RAMP:
            return on_refused_motion(now);
        case midi::STOP:
            stop_wanted_ = stop_hard_ = true;
            return;
        case midi::EMERGENCY_STOP:
            stop_wanted_ = stop_hard_ = false;
            motion_ = Motion::unknown;
            steady_begun_ = seen_moving_ = false;
            break;
        default:
            forget_parameter();
            break;
    }
    raise(MidiFault::refused);
}

/// It moves, whatever was thought of it.
void MidiMotor::on_refused_motion(base::Instant now) {
    if (refusals_ == 0) ramp_end_ = std::max(ramp_end_, now + kPatience);
    retry_at_ = now + kRetry;
    motion_ = Motion::stopping;
    steady_begun_ = goal_holds_ = false;
    if (++refusals_ > kMostRefusals) raise(MidiFault::refused);
}

/// What cannot be brought into the module must not be tried for ever.
void MidiMotor::forget_parameter() {
    repeats_ = 0;
    if (message_.number == midi::TORQUE) registers_.unset(registers::T_SOLL);
    if (message_.number == midi::TOLERANCE) registers_.unset(registers::INPOSWIN);
    if (message_.number == midi::RESET) reset_wanted_ = false;
    zero_wanted_ = zero_unclear_ = false;
}

void MidiMotor::on_accepted(base::Instant now) {
    status_is_new_ = steady_begun_ = measured_ = false;
    repeats_ = 0;
    const auto data = message_.data;
    switch (message_.number) {
        case midi::ZERO_POSITION:
            zero_wanted_ = goal_holds_ = arrived_ = false;
            position_at_ = {};
            watched_ = false;
            return;
        case midi::TORQUE:
            torque_ = static_cast<std::uint8_t>(data);
            return;
        case midi::TOLERANCE:
            tolerance_ = static_cast<std::uint8_t>(data);
            return;
        case midi::SPEED:
            period_ = static_cast<std::uint16_t>(data);
            refusals_ = 0;
            return;
        case midi::RAMP:
            ramp_ = static_cast<std::uint8_t>(data);
            refusals_ = 0;
            return;
        case midi::GO_TO:
            goal_ = static_cast<std::int32_t>(data);
            begin_motion(Motion::going, now);
            goal_holds_ = true;
            return;
        case midi::RUN:
            run_period_ = static_cast<std::uint16_t>(data);
            left_ = data >> 16 == midi::kTurnsLeft;
            ramp_end_ = now + ramp_time(ramp_, run_period_);
            return begin_motion(Motion::running, now);
        case midi::RESET:
            return begin_reset(now);
        default:
            return begin_stop(now);
    }
}

void MidiMotor::begin_motion(Motion motion, base::Instant now) {
    motion_ = motion;
    refusals_ = 0;
    doubtful_ = watched_ = arrived_ = at_speed_ = goal_holds_ = false;
    next_query_ = now;
}

/// 003 §IV: catching up is ended by 18h only, so a stop that takes longer than its ramp is helped on.
void MidiMotor::begin_stop(base::Instant now) {
    stop_wanted_ = stop_hard_ = false;
    goal_holds_ = arrived_ = at_speed_ = doubtful_ = seen_moving_ = false;
    if (motion_ != Motion::at_rest) motion_ = Motion::stopping;
    ramp_end_ = now + ramp_time(ramp_, std::max(run_period_, period_)) + kStopLate;
    next_query_ = now;
}

/// 000 §VI 00h. The position stays (R: "a status similar to the startup status").
void MidiMotor::begin_reset(base::Instant now) {
    reset_wanted_ = link_error_ = resync_ = goal_holds_ = false;
    fault_ = MidiFault::none;
    resetting_ = true;
    phase_ = Phase::resetting;
    deaf_until_ = now + kDeaf;
    counters_.orders += order_open_ ? 1U : 0U;
    order_open_ = false;
    drop_orders();
    if (is_open(access_state_)) end_access(AccessState::failed);
}

void MidiMotor::send(const Order& order) {
    if (phase_ != Phase::up || !orders_.push(order)) ++counters_.discarded;
}

void MidiMotor::stop() {
    drop_orders();
    reset_wanted_ = zero_wanted_ = zero_unclear_ = false;
    base_ = refusals_ = 0;
    registers_.set_word(registers::MODE_REG, 0);
    if (access_state_ == AccessState::waiting) end_access(AccessState::failed);
    stop_wanted_ = true;
}

bool MidiMotor::settled() const {
    if (phase_ != Phase::up) return true;
    return orders_.empty() && !order_open_ && !stop_wanted_ && !reset_wanted_ && !resync_ && !doubtful_ &&
           status_is_new_;
}

bool MidiMotor::error() const {
    return link_error_ || resetting_ || fault_ != MidiFault::none ||
           (phase_ == Phase::up && (status_ & midi::kTrips) != 0);
}

MidiFault MidiMotor::fault() const {
    if (fault_ != MidiFault::none || !error()) return fault_;
    return link_error_ ? MidiFault::link_lost : MidiFault::tripped;
}

Link MidiMotor::link() const {
    if (phase_ == Phase::down) return Link::down;
    if (phase_ != Phase::up) return Link::starting;
    return link_error_ ? Link::unacknowledged : Link::up;
}

bool MidiMotor::in_position() const {
    if (phase_ != Phase::up || error() || doubtful_) return false;
    if (mode() == 2) return motion_ == Motion::at_rest && arrived_ && goal_holds_ && target() == goal_;
    if (mode() != 1) return false;
    return v_soll() == 0 ? motion_ == Motion::at_rest : motion_ == Motion::running && at_speed_;
}

}  // namespace nplc::motor
