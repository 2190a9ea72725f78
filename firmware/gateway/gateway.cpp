#include "gateway/gateway.h"

#include <algorithm>

#include "gateway/status_light.h"

namespace nplc::gateway {

using After = HoldControl::After;

namespace {

constexpr base::Microseconds kLongestSettling{500'000};  ///< of the last orders before a hold

}  // namespace

Gateway::Gateway(const Ports& ports, const Settings& settings, StartCause cause)
    : watchdog_(ports.watchdog),
      motor_(ports.motor),
      permission_(cause),
      io_image_(ports.inputs, ports.outputs, settings.debounce),
      settings_(settings),
      scan_(ports.motor) {
    show_outputs();
    if (cause == StartCause::watchdog) block_start(SafeReason::watchdog);
}

void Gateway::block_start(SafeReason reason) {
    permission_.end_start_up();
    block(reason);
    stop_motor();
}

void Gateway::wait_for_mark(SafeReason reason) {
    waits_because_ = reason;
    if (permission_.shown(reason) == reason) block_start(reason);
}

void Gateway::block(SafeReason reason) {
    safe_.set_reason(permission_.shown(reason));
    note(static_cast<Event>(safe_.reason()));
}

void Gateway::lock(SafeReason reason) {
    permission_.lock(reason);
    block_start(reason);
}

void Gateway::unlock(SafeReason reason) {
    if (permission_.unlock(reason)) safe_.set_reason(SafeReason::not_started);
}

void Gateway::lock_and_enter_safe_state(SafeReason reason, base::Instant now) {
    permission_.end_start_up();
    permission_.lock(reason);
    enter_safe_state(reason, now);
}

Gateway::LoadResult Gateway::load(std::span<const std::uint8_t> bytes, base::Instant now, bool proven) {
    if (run_state_ != RunState::stopped) return {.fault = {base::Error::not_stopped, 0}};
    const auto fault = scan_.load(bytes);
    is_proven_ = proven;
    look_for_proof();
    if (fault) {
        enter_safe_state(SafeReason::bad_table, now);
    } else if (permission_.allows_autostart() && settings_.autostart) {
        autostart(now);
    }
    permission_.end_start_up();
    if (fault) return {.fault = *fault};
    return {.ok = true};
}

bool Gateway::needs_proof() const {
    return settings_.require_proof && !is_proven_ && !scan_.table().empty();
}

void Gateway::look_for_proof() {
    if (needs_proof()) {
        block(SafeReason::no_proof);
    } else if (safe_reason() == SafeReason::no_proof) {
        safe_.set_reason(SafeReason::not_started);
    }
}

/// Reads the pin directly, since nothing is debounced yet. If the enable input is off, no automatic start
/// stays pending.
void Gateway::autostart(base::Instant now) {
    io_image_.read(now);
    const base::Status started = run();
    if (!started && started.error() == base::Error::not_enabled)
        set_safe_reason(SafeReason::enable_lost, now);
}

base::Status Gateway::change(const Settings& settings) {
    if (run_state_ != RunState::stopped) return base::Error::not_stopped;
    settings_ = settings;
    look_for_proof();
    io_image_.set_debounce(settings.debounce);
    show_outputs();
    return {};
}

bool Gateway::enabled() const {
    return permission_.allows_start() && input_enables();
}

bool Gateway::input_enables() const {
    return !settings_.enable_input || io_image_.is_on(*settings_.enable_input);
}

base::Status Gateway::run() {
    if (has_single()) {
        hold_.set(After::never);
        return {};
    }
    return run_until(After::never);
}

base::Status Gateway::run_until(After hold_after) {
    if (is_in_service()) return base::Error::not_enabled;
    if (scan_.table().empty()) return base::Error::no_table;
    if (run_state_ != RunState::stopped && run_state_ != RunState::held) return base::Error::not_stopped;
    if (!enabled()) return base::Error::not_enabled;
    if (needs_proof()) return base::Error::no_proof;
    if (stop_unconfirmed()) return base::Error::stop_unconfirmed;
    if (run_state_ == RunState::stopped) {
        scan_.reset();
        stop_ordered_ = false;
        run_state_ = RunState::waiting_for_motor;
        is_mark_refused_ = false;
    } else {
        if (!can_go_on()) return base::Error::cannot_go_on;
        if (!settings_.virtual_motor && !scan_.mode().is_passive())
            motor_.send(scan_.mode().order(motor_.longwords_only()));
        scan_.resume();
        run_state_ = RunState::running;
    }
    hold_.leave(hold_after);
    return {};
}

base::Status Gateway::hold() {
    if (run_state_ == RunState::stopped) return base::Error::no_table;
    if (run_state_ != RunState::holding && run_state_ != RunState::held) hold_.set(After::at_once);
    return {};
}

void Gateway::enter_safe_state_by_command(base::Instant now) {
    end_forces();
    hold_.set_breakpoints(0);
    enter_safe_state(SafeReason::safe_command, now);
}

/// Not inlined, so that its stack is not part of the board's main loop.
[[gnu::noinline]] void Gateway::poll(base::Instant now) {
    scan_.wake(now);
    log_.advance(now);
    watch_polls(now);
    io_image_.read(now);
    expire_forces(now);
    note_motor_fault();
    if (motor::kLateLines) note_late_line();
    watch_stop();
    serve_sequence(now);
    show_outputs();
    motor_.begin_orders(now);
}

/// Late polls of a stopped gateway, such as during a flash erase, are not logged, since nothing moves.
void Gateway::watch_polls(base::Instant now) {
    const std::uint32_t late = polls_.begin(now);
    if (late <= settings_.poll_limit || run_state_ == RunState::stopped) return;
    if (!polls_.begins_excess(uptime())) return;
    constexpr std::uint32_t kMost = UINT16_MAX;
    note(Event::polled_late, static_cast<std::uint16_t>(std::min(late / 1000U, kMost)));
}

void Gateway::serve_sequence(base::Instant now) {
    if (run_state_ != RunState::running) watchdog_.feed();
    if (run_state_ == RunState::stopped) return;
    if (run_state_ != RunState::waiting_for_motor) watch_link(now);
    if (!input_enables()) return enter_safe_state(SafeReason::enable_lost, now);
    switch (run_state_) {
        case RunState::stopped:
        case RunState::held:
            return;
        case RunState::waiting_for_motor:
            return start_when_ready(now);
        case RunState::running:
            return scan(now);
        case RunState::holding:
            return hold_when_settled(now);
    }
}

void Gateway::start_when_ready(base::Instant now) {
    if (is_mark_refused_) return enter_safe_state(SafeReason::bad_run_mark, now);
    if (!motor::link_is_usable(motor_.link())) {
        stop_ordered_ = false;
        return;
    }
    if (settings_.on_start == OnStart::stop && !stop_ordered_) {
        stop_motor();
        stop_ordered_ = true;
    }
    if (needs_mark() || !motor_.orders_complete()) return;
    run_state_ = RunState::running;
    settings_.on_start == OnStart::stop ? scan_.mode().set_passive() : scan_.mode().forget();
    stop_after_loss_ = false;
    scan_.start(now);
    hold_asked_ = now;
    polls_.clear_worst();
    note(Event::started);
    if (hold_.breaks_at(state().step)) begin_hold(true, now);
}

/// Only a finished or skipped scan feeds the watchdog.
void Gateway::scan(base::Instant now) {
    scan_.count_timer(now);
    if (!hold_.is_at_once()) hold_asked_ = now;
    if (hold_.is_at_once() && scan_.is_under_way() && settles_too_long(now)) {
        scan_.abort();
        scan_.mode().forget();
    }
    if (hold_.is_at_once() && !scan_.is_under_way()) return begin_hold(false, now);
    const SequenceScan::Result result = scan_.poll(inputs(), now);
    if (result == SequenceScan::Result::waiting) {
        if (scan_.timed_out(settings_.longest_wait, now)) enter_safe_state(SafeReason::motor_stuck, now);
        return;
    }
    const bool finished = result == SequenceScan::Result::finished;
    if (finished) leave_safe_state();
    watchdog_.feed();
    hold_if_due(finished && scan_.has_entered_step(), now);
    if (finished) scan_.report(now);
}

void Gateway::leave_safe_state() {
    if (safe_reason() == SafeReason::link_down) return;
    safe_.leave();
    show_outputs();
}

void Gateway::hold_if_due(bool entered_step, base::Instant now) {
    const bool breakpoint = entered_step && hold_.breaks_at(state().step);
    if (breakpoint || hold_.is_due(entered_step)) begin_hold(breakpoint, now);
}

void Gateway::begin_hold(bool breakpoint, base::Instant now) {
    hold_.begin(breakpoint);
    scan_.note_progress(now);
    stop_ordered_ = settings_.virtual_motor;
    run_state_ = RunState::holding;
}

/// Lets the orders of the last scan finish before the stop, which would drop them. Orders that keep the motor
/// busy for longer than kLongestSettling are dropped, and the sequence cannot continue from there.
void Gateway::hold_when_settled(base::Instant now) {
    if (!motor_.orders_complete()) {
        if (scan_.timed_out(settings_.longest_wait, now))
            return enter_safe_state(SafeReason::motor_stuck, now);
        if (stop_ordered_ || !settles_too_long(now)) return;
        scan_.mode().forget();
    }
    if (!stop_ordered_) {
        stop_motor();
        stop_ordered_ = true;
        scan_.note_progress(now);
        return;
    }
    run_state_ = RunState::held;
    constexpr std::uint16_t kCannotGoOn = 1;
    note(hold_.at_breakpoint() ? Event::breakpoint : Event::held, can_go_on() ? 0 : kCannotGoOn);
}

/// A lost link is a safe state in which the sequence runs on, with ERROR, until it has acknowledged the
/// error. The motor is stopped at once, since it may still receive although nothing is received from it, and
/// again when the link is back: the first stop may have been given up.
void Gateway::watch_link(base::Instant now) {
    const motor::Link link = motor_.link();
    if (link != motor::Link::up) set_safe_reason(SafeReason::link_down, now);
    const bool is_lost = !motor::link_is_usable(link);
    if (is_lost != stop_after_loss_) {
        stop_after_loss_ = is_lost;
        stop_motor();
    }
    if (is_lost) return scan_.mode().set_passive();
    if (link == motor::Link::up && safe_reason() == SafeReason::link_down) {
        safe_.leave();
        note(Event::link_up);
    }
}

void Gateway::note_motor_fault() {
    const std::uint8_t fault = motor_.fault_number();
    if (fault == motor_fault_) return;
    motor_fault_ = fault;
    if (fault != 0) note(Event::motor_fault, fault);
}

void Gateway::note_late_line() {
    const base::Microseconds echo = motor_.echo_time();
    const bool late = echo > motor::kLongestEcho;
    if (late && !line_is_late_) note(Event::line_late, static_cast<std::uint16_t>(echo.count() / 1'000));
    if (late || motor_.link() == motor::Link::up) line_is_late_ = late;
}

void Gateway::enter_safe_state(SafeReason reason, base::Instant now) {
    run_state_ = RunState::stopped;
    scan_.abort();
    hold_.set(After::never);
    set_safe_reason(reason, now);
    stop_motor();
    stop_watched_ = true;
}

void Gateway::stop_motor() {
    if (!stop_unconfirmed()) stop_asked_ = uptime();
    motor_.stop();
}

void Gateway::watch_stop() {
    if (!stop_watched_ || !motor_.stop_confirmed()) return;
    stop_watched_ = false;
    if (settings_.virtual_motor) return;
    constexpr std::uint32_t kMost = UINT16_MAX;
    note(Event::stop_confirmed, static_cast<std::uint16_t>(std::min(uptime() - stop_asked_, kMost)));
}

void Gateway::give_up_stop() {
    stop_watched_ = false;
    motor_.give_up_stop();
}

void Gateway::set_safe_reason(SafeReason reason, base::Instant now) {
    log_.advance(now);
    reason = permission_.shown(needs_proof() ? SafeReason::no_proof : reason);
    if (safe_.enter(reason, now, uptime())) note(static_cast<Event>(reason));
    show_outputs();
}

void Gateway::note(Event event, std::uint16_t detail) {
    log_.add(static_cast<std::uint8_t>(event), state().step, detail);
}

void Gateway::force_inputs(const Force& force, base::Instant now) {
    io_image_.forces().set_inputs(force, now);
    note(Event::forced, registers::gateway::FORCE_IN);
}

void Gateway::force_outputs(const Force& force, base::Instant now) {
    io_image_.forces().set_outputs(force, now);
    note(Event::forced, registers::gateway::FORCE_OUT);
    show_outputs();
}

void Gateway::end_forces() {
    if (!forces().any()) return;
    io_image_.forces().end();
    note(Event::forces_ended);
    show_outputs();
}

void Gateway::expire_forces(base::Instant now) {
    if (!forces().any() || forces().left(now, settings_.force_time).count() != 0) return;
    io_image_.forces().end();
    constexpr std::uint16_t kBySilence = 1;
    note(Event::forces_ended, kBySilence);
}

/// The safe values, or the sequence's outputs with forces applied; and the status lamp, if there is one.
void Gateway::show_outputs() {
    unsigned levels =
        safe_reason() == SafeReason::none ? forces().outputs().over(state().outputs) : settings_.safe_outputs;
    if (settings_.status_output && *settings_.status_output < 4) {
        const unsigned lamp = 1U << *settings_.status_output;
        const bool on = status_light(run_state_, safe_reason(), uptime());
        levels = (levels & ~lamp) | (on ? lamp : 0U);
    }
    io_image_.write(static_cast<std::uint8_t>(levels));
}

base::Instant Gateway::next_poll(base::Instant now, base::Instant motors) {
    base::Instant next = std::min({motors, io_image_.next_update(), forces().end(settings_.force_time)});
    if (settings_.status_output) {
        const std::uint32_t beat = next_status_light(run_state_, safe_reason(), uptime());
        if (beat != 0) next = std::min(next, log_.uptime_in(beat));
    }
    next = std::max(now, std::min(next, next_work(now)));
    scan_.times().sleep_until(next);
    return next;
}

base::Instant Gateway::settling_ends() const {
    return hold_asked_ + kLongestSettling + base::Microseconds(1);
}

base::Instant Gateway::next_work(base::Instant now) const {
    switch (run_state_) {
        case RunState::stopped:
        case RunState::held:
            return base::kNever;
        case RunState::waiting_for_motor: {
            if (is_mark_refused_) return now;
            if (!motor::link_is_usable(motor_.link())) return base::kNever;
            const bool has_to_stop = settings_.on_start == OnStart::stop && !stop_ordered_;
            return has_to_stop || (!needs_mark() && motor_.orders_complete()) ? now : base::kNever;
        }
        case RunState::holding:
            if (motor_.orders_complete()) return now;
            return std::min(scan_.deadline(settings_.longest_wait),
                            stop_ordered_ ? base::kNever : settling_ends());
        case RunState::running:
            if (!hold_.is_at_once()) return scan_.next_poll(inputs(), settings_.longest_wait, now);
            if (!scan_.is_under_way()) return now;
            return std::min(settling_ends(), scan_.next_poll(inputs(), settings_.longest_wait, now));
    }
    return now;
}

}  // namespace nplc::gateway
