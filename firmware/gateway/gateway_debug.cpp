// Holding the sequence and forcing signals: what a person does to a running table.
#include "gateway/gateway.h"
#include "protocol/fastmac.h"
#include "registers/mac.h"

namespace nplc::gateway {

base::Status Gateway::run() {
    if (has_single()) {
        hold_after_ = HoldAfter::never;
        return {};
    }
    return run_until(HoldAfter::never);
}

base::Status Gateway::run_until(HoldAfter hold_after) {
    if (table_.empty()) return base::Error::no_table;
    if (run_state_ != RunState::stopped && run_state_ != RunState::held) return base::Error::not_stopped;
    if (!enabled()) return base::Error::not_enabled;
    if (run_state_ == RunState::held) {
        if (!can_go_on()) return base::Error::cannot_go_on;
        take_up_mode();
    }
    quiet_key_.reset();
    hold_after_ = hold_after;
    broke_ = false;
    if (run_state_ == RunState::stopped) {
        engine_.reset();
        stop_ordered_ = false;
        run_state_ = RunState::waiting_for_motor;
    } else {
        resumes_ = true;
        run_state_ = RunState::running;
    }
    return {};
}

base::Status Gateway::hold() {
    if (run_state_ == RunState::stopped) return base::Error::no_table;
    if (run_state_ != RunState::holding && run_state_ != RunState::held) hold_after_ = HoldAfter::at_once;
    return {};
}

void Gateway::hold_if_due(bool entered_step, base::Instant now) {
    const bool breakpoint = entered_step && breaks_at(engine_.state().step);
    const bool due = hold_after_ == HoldAfter::scan || (hold_after_ == HoldAfter::step && entered_step);
    if (breakpoint || due) begin_hold(breakpoint, now);
}

void Gateway::begin_hold(bool breakpoint, base::Instant now) {
    hold_after_ = HoldAfter::never;
    broke_ = breakpoint;
    stop_ordered_to_hold_ = settings_.virtual_motor;
    run_state_ = RunState::holding;
    progress_ = now;
}

/// The orders of the last scan first, then the stop, which would drop them.
void Gateway::hold_when_settled(base::Instant now) {
    if (!ports_.motor.settled()) {
        if (now - progress_ > settings_.longest_wait) enter_safe_state(SafeReason::motor_stuck, now);
        return;
    }
    if (!stop_ordered_to_hold_) {
        ports_.motor.stop();
        stop_ordered_to_hold_ = true;
        progress_ = now;
        return;
    }
    run_state_ = RunState::held;
    constexpr std::uint16_t kCannotGoOn = 1;
    note(broke_ ? Event::breakpoint : Event::held, can_go_on() ? 0 : kCannotGoOn);
}

/// 001 §5.2.1.4. An error that no scan saw may have ended a motion before "reset error", and a home search
/// ends in a mode of the motor's own choice.
void Gateway::follow_mode(const sequencer::MotorOrder& order) {
    using protocol::fastmac::command_byte;
    using protocol::fastmac::Number;
    constexpr std::uint8_t kCommandMode = 3;
    if (order.is_flex) {
        const auto word = static_cast<std::uint16_t>(order.value);
        if (order.reg == registers::MODE_REG)
            mode_ = word <= 2 ? static_cast<std::uint8_t>(word) : kUnknownMode;
        return;
    }
    const auto mode = static_cast<std::uint8_t>(order.command >> 5 & 3);
    if (mode != kCommandMode)
        mode_ = mode;
    else if (order.command == command_byte(Number::home) ||
             (order.command == command_byte(Number::reset_error) && mode_ != 0))
        mode_ = kUnknownMode;
}

/// P_SOLL and V_SOLL are as they were, so nothing is moved twice.
void Gateway::take_up_mode() {
    if (mode_ == 0 || settings_.virtual_motor) return;
    ports_.motor.send({.is_register_write = true,
                       .reg = registers::MODE_REG,
                       .longword = ports_.motor.longwords_only(),
                       .value = mode_});
}

void Gateway::make_safe(base::Instant now) {
    end_forces();
    breakpoints_ = 0;
    enter_safe_state(SafeReason::safe_command, now);
}

void Gateway::withdraw(SafeReason reason, base::Instant now) {
    starting_up_ = false;
    locked_by_ = reason;
    enter_safe_state(reason, now);
}

void Gateway::force_inputs(const Forced& forced, base::Instant now) {
    forces_.set_inputs(forced, now);
    note(Event::forced, registers::gateway::FORCE_IN);
}

void Gateway::force_outputs(const Forced& forced, base::Instant now) {
    forces_.set_outputs(forced, now);
    note(Event::forced, registers::gateway::FORCE_OUT);
    show_outputs();
}

void Gateway::end_forces() {
    if (!forces_.any()) return;
    forces_.end();
    note(Event::forces_ended);
    show_outputs();
}

void Gateway::expire_forces(base::Instant now) {
    if (!forces_.any() || forces_.left(now, settings_.force_time).count() != 0) return;
    forces_.end();
    constexpr std::uint16_t kBySilence = 1;
    note(Event::forces_ended, kBySilence);
}

}  // namespace nplc::gateway
