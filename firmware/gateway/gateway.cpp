#include "gateway/gateway.h"

#include <algorithm>
#include <utility>

#include "gateway/status_light.h"

namespace nplc::gateway {

namespace {

/// The safe state is there within 10 ms of the loss of the enable input.
base::Microseconds quick(base::Microseconds debounce) {
    constexpr base::Microseconds kMost{9'000};
    return std::min(debounce, kMost);
}

}  // namespace

motor::Order Gateway::to_motor(const sequencer::MotorOrder& order) {
    return {.is_register_write = order.is_flex,
            .command = order.command,
            .reg = order.reg,
            .longword = order.longword,
            .value = order.value};
}

bool Gateway::motor_takes(sequencer::TermView term) const {
    return !sequencer::has_order(term) || ports_.motor.can_execute(to_motor(sequencer::order_of(term)));
}

Gateway::Gateway(const Ports& ports, const Settings& settings, StartCause cause)
    : ports_(ports),
      in_service_(cause == StartCause::service),
      starting_up_(cause == StartCause::power_up),
      settings_(settings),
      debouncer_(settings.debounce),
      quick_debouncer_(quick(settings.debounce)) {
    show_outputs();
    if (cause == StartCause::watchdog) block_start(SafeReason::watchdog);
}

void Gateway::block_start(SafeReason reason) {
    starting_up_ = false;
    safe_reason_ = locked_by_ == SafeReason::none ? reason : locked_by_;
    note(static_cast<Event>(safe_reason_));
    ports_.motor.stop();
}

void Gateway::lock(SafeReason reason) {
    locked_by_ = reason;
    block_start(reason);
}

void Gateway::unlock(SafeReason reason) {
    if (locked_by_ != reason) return;
    locked_by_ = SafeReason::none;
    safe_reason_ = SafeReason::not_started;
}

Gateway::LoadResult Gateway::load(std::span<const std::uint8_t> bytes, base::Instant now) {
    if (run_state_ != RunState::stopped) return {.fault = {base::Error::not_stopped, 0}};
    auto fault = table_.assign(bytes);
    if (!fault) fault = fault_for_motor();
    engine_.reset();
    if (fault) {
        table_.clear();
        enter_safe_state(SafeReason::bad_table, now);
    } else if (starting_up_ && settings_.autostart) {
        start_by_itself(now);
    }
    starting_up_ = false;
    if (fault) return {.fault = *fault};
    return {.ok = true};
}

/// The pin itself, since nothing was debounced yet. Without it nothing stays armed.
void Gateway::start_by_itself(base::Instant now) {
    read_inputs(now);
    const base::Status started = run();
    if (!started && started.error() == base::Error::not_enabled)
        set_safe_reason(SafeReason::enable_lost, now);
}

std::optional<sequencer::TableFault> Gateway::fault_for_motor() const {
    for (std::size_t i = 0; i < table_.size(); ++i) {
        if (!motor_takes(table_.term(i)))
            return sequencer::TableFault{base::Error::not_for_motor, static_cast<std::uint16_t>(i)};
    }
    return std::nullopt;
}

void Gateway::read_inputs(base::Instant now) {
    const std::uint8_t levels = ports_.inputs.read();
    debouncer_.update(levels, now);
    quick_debouncer_.update(levels, now);
}

/// By itself, so that its stack is not the board's loop's.
[[gnu::noinline]] void Gateway::poll(base::Instant now) {
    if (may_rest_until_ && rests_ && scan_ended_) scan_ended_ = std::min(now, *may_rest_until_);
    may_rest_until_.reset();
    uptime_.advance(now);
    read_inputs(now);
    expire_forces(now);
    note_motors_fault();
    serve_sequence(now);
    show_outputs();
    ports_.motor.begin_orders(now);
}

void Gateway::serve_sequence(base::Instant now) {
    switch (run_state_) {
        case RunState::stopped:
            ports_.watchdog.feed();
            break;
        case RunState::waiting_for_motor:
            ports_.watchdog.feed();
            if (!input_enables()) return enter_safe_state(SafeReason::enable_lost, now);
            start_when_ready(now);
            break;
        case RunState::running:
        case RunState::holding:
        case RunState::held:
            if (run_state_ != RunState::running) ports_.watchdog.feed();
            watch_link(now);
            if (!input_enables()) return enter_safe_state(SafeReason::enable_lost, now);
            if (run_state_ == RunState::running) return work(now);
            if (run_state_ == RunState::holding) return hold_when_settled(now);
            break;
    }
}

void Gateway::note_motors_fault() {
    const std::uint8_t fault = ports_.motor.fault_number();
    if (fault == motors_fault_) return;
    motors_fault_ = fault;
    if (fault != 0) note(Event::motor_fault, fault);
}

bool Gateway::enabled() const {
    return !in_service_ && locked_by_ == SafeReason::none && input_enables();
}

bool Gateway::input_enables() const {
    if (!settings_.enable_input) return true;
    const unsigned input = *settings_.enable_input;
    const unsigned both = unsigned{debouncer_.levels()} & quick_debouncer_.levels();
    return input < 6 && ((both >> input) & 1U) != 0;
}

void Gateway::start_when_ready(base::Instant now) {
    if (!motor::delivers(ports_.motor.link())) {
        stop_ordered_ = false;
        return;
    }
    if (settings_.on_start == OnStart::stop && !stop_ordered_) {
        ports_.motor.stop();
        stop_ordered_ = true;
    }
    if (!ports_.motor.settled()) return;
    run_state_ = RunState::running;
    mode_ = settings_.on_start == OnStart::stop ? 0 : kUnknownMode;
    stop_after_loss_ = false;
    in_scan_ = false;
    progress_ = ticked_ = now;
    scan_ended_.reset();
    worst_scan_time_ = {};
    note(Event::started);
    if (breaks_at(engine_.state().step)) begin_hold(true, now);
}

/// A lost link is a safe state in which the sequence runs on, with ERROR, until it has acknowledged.
void Gateway::watch_link(base::Instant now) {
    const motor::Link link = ports_.motor.link();
    if (link != motor::Link::up) set_safe_reason(SafeReason::link_down, now);
    if (!motor::delivers(link)) {
        stop_after_loss_ = true;
        mode_ = 0;
        return;
    }
    if (stop_after_loss_) {
        ports_.motor.stop();
        stop_after_loss_ = false;
    }
    if (link == motor::Link::up && safe_reason_ == SafeReason::link_down) {
        safe_reason_ = SafeReason::none;
        note(Event::link_up);
    }
}

void Gateway::set_safe_reason(SafeReason reason, base::Instant now) {
    uptime_.advance(now);
    if (locked_by_ != SafeReason::none) reason = locked_by_;
    if (safe_reason_ != reason) {
        safe_since_ = now;
        safe_since_uptime_ = uptime_.milliseconds();
        log_.add({safe_since_uptime_, static_cast<std::uint8_t>(reason), engine_.state().step, 0});
    }
    safe_reason_ = reason;
    show_outputs();
}

void Gateway::enter_safe_state(SafeReason reason, base::Instant now) {
    run_state_ = RunState::stopped;
    in_scan_ = false;
    held_.reset();
    hold_after_ = HoldAfter::never;
    set_safe_reason(reason, now);
    ports_.motor.stop();
}

void Gateway::work(base::Instant now) {
    if (std::exchange(resumes_, false)) {
        progress_ = ticked_ = now;
        scan_ended_.reset();
    }
    count_timer(now);
    if (!in_scan_ && hold_after_ == HoldAfter::at_once) return begin_hold(false, now);
    if ((in_scan_ || begin_scan(now)) && send_orders(now)) {
        finish_scan(now);
    } else if (now - progress_ > settings_.longest_wait) {
        enter_safe_state(SafeReason::motor_stuck, now);
    }
}

/// False while the motor is not settled. A scan that can change nothing is finished at once.
bool Gateway::begin_scan(base::Instant now) {
    if (now < next_scan_) return false;
    const bool rested = std::exchange(rests_, false);
    if (!ports_.motor.settled()) {
        if (rested) progress_ = now;
        return false;
    }
    progress_ = now;
    image_ = present_image();
    if ((image_ & sequencer::kError) != 0) mode_ = 0;  // it has stopped by itself
    if (quiet_key_ == engine_.key(image_)) {
        note_scan_end(now);
        rests_ = true;
        hold_if_due(false, now);
        return false;
    }
    quiet_key_ = engine_.key(image_);
    before_ = engine_.state();
    engine_.begin(image_);
    in_scan_ = true;
    return true;
}

sequencer::InputImage Gateway::present_image() const {
    return static_cast<sequencer::InputImage>(inputs() |
                                              (ports_.motor.in_position() ? sequencer::kInPos : 0) |
                                              (ports_.motor.error() ? sequencer::kError : 0));
}

/// False while an order has to wait for room.
bool Gateway::send_orders(base::Instant now) {
    for (;;) {
        if (!held_) held_ = engine_.next();
        if (!held_) return true;
        if (!ports_.motor.has_room()) return false;
        ports_.motor.send(to_motor(*held_));
        follow_mode(*held_);
        ports_.motor.begin_orders(now);
        if (observer_ != nullptr) observer_->ordered(now, *held_);
        held_.reset();
        progress_ = now;
    }
}

void Gateway::finish_scan(base::Instant now) {
    const sequencer::ScanEffect effect = engine_.finish();
    if (effect.any()) quiet_key_.reset();
    rests_ = !effect.any();
    if (effect.any()) next_scan_ = now + pace_;
    if (effect.timer_preset) ticked_ = now;
    if (safe_reason_ != SafeReason::link_down) {
        safe_reason_ = SafeReason::none;
        show_outputs();
    }
    in_scan_ = false;
    note_scan_end(now);
    hold_if_due(engine_.state().step != before_.step, now);
    if (observer_ != nullptr) observer_->scanned(now, before_, image_, engine_.state());
}

void Gateway::count_timer(base::Instant now) {
    constexpr base::Milliseconds kLongestTimer{65'535};
    if (now - ticked_ > kLongestTimer) ticked_ = now - kLongestTimer;  // the timer is at 0 then in any case
    const std::uint32_t milliseconds = static_cast<std::uint32_t>((now - ticked_).count()) / 1000U;
    if (milliseconds == 0) return;
    ticked_ += base::Milliseconds(milliseconds);
    engine_.elapse(milliseconds);
}

void Gateway::note_scan_end(base::Instant now) {
    ++scans_;
    ports_.watchdog.feed();
    scan_time_ = scan_ended_ ? now - *scan_ended_ : base::Microseconds{};
    worst_scan_time_ = std::max(worst_scan_time_, scan_time_);
    scan_ended_ = now;
}

void Gateway::note(Event event, std::uint16_t detail) {
    log_.add({uptime_.milliseconds(), static_cast<std::uint8_t>(event), engine_.state().step, detail});
}

base::Status Gateway::change(const Settings& settings) {
    if (run_state_ != RunState::stopped) return base::Error::not_stopped;
    settings_ = settings;
    debouncer_.set_steady(settings.debounce);
    quick_debouncer_.set_steady(quick(settings.debounce));
    show_outputs();
    return {};
}

/// The safe values, or what the sequence wrote under what is forced; and the lamp, if there is one.
void Gateway::show_outputs() {
    unsigned levels = safe_reason_ == SafeReason::none ? forces_.outputs().over(engine_.state().outputs)
                                                       : settings_.safe_outputs;
    if (settings_.status_output && *settings_.status_output < 4) {
        const unsigned lamp = 1U << *settings_.status_output;
        const bool on = status_light(run_state_, safe_reason_, uptime_.milliseconds());
        levels = (levels & ~lamp) | (on ? lamp : 0U);
    }
    write_outputs(static_cast<std::uint8_t>(levels));
}

void Gateway::write_outputs(std::uint8_t levels) {
    if (written_ == levels) return;
    ports_.outputs.write(levels);
    written_ = levels;
}

}  // namespace nplc::gateway
