#include "gateway/sequence_scan.h"

#include <algorithm>
#include <utility>

namespace nplc::gateway {

bool SequenceScan::motor_takes(sequencer::TermView term) const {
    return !sequencer::has_order(term) || motor_.can_execute(sequencer::order_of(term));
}

std::optional<sequencer::TableFault> SequenceScan::load(std::span<const std::uint8_t> bytes) {
    auto fault = table_.assign(bytes);
    for (std::size_t i = 0; !fault && i < table_.size(); ++i) {
        if (!motor_takes(table_.term(i)))
            fault = sequencer::TableFault{base::Error::not_for_motor, static_cast<std::uint16_t>(i)};
    }
    if (fault) table_.clear();
    engine_.reset();
    return fault;
}

void SequenceScan::reset() {
    unchanged_key_.reset();
    engine_.reset();
}

void SequenceScan::start(base::Instant now) {
    in_scan_ = false;
    progress_ = ticked_ = now;
    times_.interrupt();
    times_.clear_worst();
}

void SequenceScan::resume() {
    unchanged_key_.reset();
    resumes_ = true;
}

void SequenceScan::abort() {
    in_scan_ = false;
    waiting_order_.reset();
}

void SequenceScan::count_timer(base::Instant now) {
    if (std::exchange(resumes_, false)) {
        progress_ = ticked_ = now;
        times_.interrupt();
    }
    constexpr base::Milliseconds kLongestTimer{65'535};
    if (now - ticked_ > kLongestTimer) ticked_ = now - kLongestTimer;  // the timer is 0 in any case
    const std::uint32_t milliseconds = static_cast<std::uint32_t>((now - ticked_).count()) / 1000U;
    if (milliseconds == 0) return;
    ticked_ += base::Milliseconds(milliseconds);
    engine_.elapse(milliseconds);
}

[[gnu::noinline]] SequenceScan::Result SequenceScan::poll(std::uint8_t inputs, base::Instant now) {
    if (!in_scan_) {
        const Result result = begin(inputs, now);
        if (!in_scan_) return result;
    }
    if (!send_orders(now)) return Result::waiting;
    finish(now);
    return Result::finished;
}

/// Begins a scan, unless the motor is not ready or nothing can change.
SequenceScan::Result SequenceScan::begin(std::uint8_t inputs, base::Instant now) {
    if (now < next_scan_) return Result::waiting;
    const bool was_idle = std::exchange(idle_, false);
    if (!motor_.orders_complete()) {
        if (was_idle) progress_ = now;
        return Result::waiting;
    }
    progress_ = now;
    if (take_values(now)) return Result::waiting;
    image_ = present_image(inputs);
    if ((image_ & sequencer::kError) != 0) mode_.set_passive();
    if (unchanged_key_ == engine_.key(image_)) {
        idle_ = true;
        times_.note_end(now);
        return Result::skipped;
    }
    unchanged_key_ = engine_.key(image_);
    before_ = engine_.state();
    engine_.begin(image_);
    in_scan_ = true;
    return Result::waiting;
}

/// Not during a move, nor while a written value would be lost. POWER_UP writes all values itself.
bool SequenceScan::may_take_values() const {
    if constexpr (NPLC_SET_POINTS == 0) return false;
    const std::uint8_t step = engine_.state().step;
    if (values_ == nullptr || !values_->has_change(step)) return false;
    if (step == 0) return true;
    const bool moves = !mode_.is_passive() && !mode_.is_velocity() && !motor_.in_position();
    return !moves && !motor_.error() && motor_.link() == motor::Link::up;
}

/// True while the motor still has to take a value.
bool SequenceScan::take_values(base::Instant now) {
    if (!may_take_values()) return false;
    const auto order = values_->take(engine_.state().step);
    if (!order) return false;
    motor_.send(*order);
    motor_.begin_orders(now);
    if (observer_ != nullptr) observer_->ordered(now, *order);
    return true;
}

sequencer::InputImage SequenceScan::present_image(std::uint8_t inputs) const {
    return static_cast<sequencer::InputImage>(inputs | (motor_.in_position() ? sequencer::kInPos : 0) |
                                              (motor_.error() ? sequencer::kError : 0));
}

/// False while an order waits for room.
bool SequenceScan::send_orders(base::Instant now) {
    for (;;) {
        if (!waiting_order_) waiting_order_ = engine_.next();
        if (!waiting_order_) return true;
        if (!motor_.has_room()) return false;
        motor_.send(*waiting_order_);
        mode_.follow(*waiting_order_);
        motor_.begin_orders(now);
        if (observer_ != nullptr) observer_->ordered(now, *waiting_order_);
        waiting_order_.reset();
        progress_ = now;
    }
}

void SequenceScan::finish(base::Instant now) {
    const sequencer::ScanEffect effect = engine_.finish();
    idle_ = !effect.any();
    if (effect.any()) {
        unchanged_key_.reset();
        next_scan_ = now + pace_;
    }
    if (effect.timer_preset) ticked_ = now;
    in_scan_ = false;
    times_.note_end(now);
}

void SequenceScan::report(base::Instant now) const {
    if (observer_ != nullptr) observer_->scanned(now, before_, image_, engine_.state());
}

base::Instant SequenceScan::next_poll(std::uint8_t inputs, base::Microseconds longest_wait,
                                      base::Instant now) const {
    if (resumes_) return now;
    if (in_scan_) return motor_.has_room() ? now : deadline(longest_wait);
    if (!motor_.orders_complete()) return idle_ ? now : deadline(longest_wait);
    if (may_take_values()) return std::max(now, next_scan_);
    // At once unless a scan would change nothing; else when the timer reaches 0, the only part of the key
    // that changes without an event.
    if (unchanged_key_ != engine_.key(present_image(inputs))) return std::max(now, next_scan_);
    const std::uint16_t timer = engine_.state().timer;
    return timer == 0 ? base::kNever : ticked_ + base::Milliseconds(timer);
}

}  // namespace nplc::gateway
