#include "gateway/gateway.h"

namespace nplc::gateway {
namespace {

motor::Order to_motor(const sequencer::MotorOrder& order) {
    return {.is_register_write = order.is_flex,
            .command = order.command,
            .reg = order.reg,
            .longword = order.longword,
            .value = order.value};
}

}  // namespace

Gateway::Gateway(const Ports& ports, const Settings& settings, StartCause cause)
    : ports_(ports),
      settings_(settings),
      debouncer_(settings.debounce),
      autostart_(settings.autostart && cause == StartCause::power_up) {
    write_outputs(settings_.safe_outputs);
    if (cause == StartCause::watchdog) {
        safe_reason_ = SafeReason::watchdog;
        ports_.motor.stop();
    }
}

sequencer::Table::LoadResult Gateway::load(std::span<const std::uint8_t> bytes, base::Instant now) {
    if (run_state_ != RunState::stopped)
        return {.ok = false, .table = {}, .fault = {base::Error::not_stopped, 0}};
    auto result = sequencer::Table::load(bytes);
    if (result.ok) result = checked_for_motor(result);
    table_ = result.table;
    engine_.reset();
    if (!result.ok) {
        enter_safe_state(SafeReason::bad_table, now);
    } else if (autostart_) {
        static_cast<void>(run());
    }
    autostart_ = false;
    return result;
}

sequencer::Table::LoadResult Gateway::checked_for_motor(const sequencer::Table::LoadResult& loaded) const {
    for (std::size_t i = 0; i < loaded.table.size(); ++i) {
        const sequencer::TermView term = loaded.table.term(i);
        if (!sequencer::has_order(term) || ports_.motor.can_execute(to_motor(sequencer::order_of(term))))
            continue;
        return {
            .ok = false, .table = {}, .fault = {base::Error::not_for_motor, static_cast<std::uint16_t>(i)}};
    }
    return loaded;
}

base::Status Gateway::run() {
    if (run_state_ != RunState::stopped) return base::Error::not_stopped;
    if (table_.empty()) return base::Error::no_table;
    engine_.reset();
    quiet_key_.reset();
    stop_ordered_ = false;
    run_state_ = RunState::waiting_for_motor;
    return {};
}

void Gateway::poll(base::Instant now) {
    ports_.motor.poll(now);
    debouncer_.update(ports_.inputs.read(), now);
    switch (run_state_) {
        case RunState::stopped:
            ports_.watchdog.feed();
            break;
        case RunState::waiting_for_motor:
            start_when_ready(now);
            ports_.watchdog.feed();
            break;
        case RunState::running:
            watch_link(now);
            if (enabled()) {
                work(now);
            } else {
                enter_safe_state(SafeReason::enable_lost, now);
            }
            break;
    }
}

bool Gateway::enabled() const {
    if (!settings_.enable_input) return true;
    const unsigned input = *settings_.enable_input;
    return input < 6 && ((unsigned{debouncer_.levels()} >> input) & 1U) != 0;
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
    if (!ports_.motor.settled() || !enabled()) return;
    run_state_ = RunState::running;
    stop_after_loss_ = false;
    in_scan_ = false;
    progress_ = ticked_ = now;
}

/// A lost link is a safe state in which the sequence runs on, with ERROR, until it has acknowledged.
void Gateway::watch_link(base::Instant now) {
    const motor::Link link = ports_.motor.link();
    if (link != motor::Link::up) set_safe_reason(SafeReason::link_down, now);
    if (!motor::delivers(link)) {
        stop_after_loss_ = true;
        return;
    }
    if (stop_after_loss_) {
        ports_.motor.stop();
        stop_after_loss_ = false;
    }
    if (link == motor::Link::up && safe_reason_ == SafeReason::link_down) {
        safe_reason_ = SafeReason::none;
        write_outputs(engine_.state().outputs);
    }
}

void Gateway::set_safe_reason(SafeReason reason, base::Instant now) {
    if (safe_reason_ != reason) safe_since_ = now;
    safe_reason_ = reason;
    write_outputs(settings_.safe_outputs);
}

void Gateway::enter_safe_state(SafeReason reason, base::Instant now) {
    run_state_ = RunState::stopped;
    in_scan_ = false;
    held_.reset();
    set_safe_reason(reason, now);
    ports_.motor.stop();
}

void Gateway::work(base::Instant now) {
    count_timer(now);
    if ((in_scan_ || begin_scan(now)) && send_orders(now)) {
        finish_scan(now);
    } else if (now - progress_ > settings_.longest_wait) {
        enter_safe_state(SafeReason::motor_stuck, now);
    }
}

/// False while the motor is not settled. A scan that can change nothing is finished at once.
bool Gateway::begin_scan(base::Instant now) {
    if (!ports_.motor.settled()) return false;
    progress_ = now;
    image_ = static_cast<sequencer::InputImage>(debouncer_.levels() |
                                                (ports_.motor.in_position() ? sequencer::kInPos : 0) |
                                                (ports_.motor.error() ? sequencer::kError : 0));
    if (quiet_key_ == engine_.key(image_)) {
        ++scans_;
        ports_.watchdog.feed();
        return false;
    }
    quiet_key_ = engine_.key(image_);
    before_ = engine_.state();
    engine_.begin(image_);
    in_scan_ = true;
    return true;
}

/// False while an order has to wait for room.
bool Gateway::send_orders(base::Instant now) {
    for (;;) {
        if (!held_) held_ = engine_.next();
        if (!held_) return true;
        if (!ports_.motor.has_room()) return false;
        ports_.motor.send(to_motor(*held_));
        if (observer_ != nullptr) observer_->ordered(now, *held_);
        held_.reset();
        progress_ = now;
    }
}

void Gateway::finish_scan(base::Instant now) {
    const sequencer::ScanEffect effect = engine_.finish();
    if (effect.any()) quiet_key_.reset();
    if (effect.timer_preset) ticked_ = now;
    if (safe_reason_ != SafeReason::link_down) {
        safe_reason_ = SafeReason::none;
        write_outputs(engine_.state().outputs);
    }
    in_scan_ = false;
    ++scans_;
    ports_.watchdog.feed();
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

void Gateway::write_outputs(std::uint8_t levels) {
    if (written_ == levels) return;
    ports_.outputs.write(levels);
    written_ = levels;
}

}  // namespace nplc::gateway
