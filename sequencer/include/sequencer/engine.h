#pragma once

#include <cstdint>
#include <optional>

#include "sequencer/state.h"
#include "sequencer/table.h"

namespace nplc::sequencer {

/// What a finished scan did. A scan that did nothing would do nothing again with the same Key in the same
/// step.
struct ScanEffect {
    bool changed = false;  ///< wrote step, outputs, counter or timer with something new
    bool sent = false;     ///< at least one order
    bool timer_preset = false;
    bool any() const { return changed || sent; }
};

/// Runs a Table in place (001 §6.1.9). The scan's four steps are four calls, so that it can halt between
/// orders while the motor's queue is full:
///
///     engine.begin(image);                         // 1: freezes HW_INP, timer = 0 and counter = 0
///     while (auto order = engine.next()) send(*order);   // 2
///     engine.finish();                             // 3: step, counter, timer preset; outputs() are new
///     engine.elapse(ms);                           // 4: may also be called while the scan is halted
class Engine {
  public:
    explicit Engine(const Table& table) : table_(&table) {}

    /// Power-up: step 0, timer, counter and outputs 0. A scan under way is dropped.
    void reset() { restore({}); }

    /// Goes on from `state` (step 0..62). A scan under way is dropped.
    void restore(const State& state) {
        state_ = state;
        range_ = {};
        pending_ = {};
        sent_ = false;
    }
    const State& state() const { return state_; }
    const Table& table() const { return *table_; }

    void begin(InputImage image) {
        range_ = table_->terms_of(state_.step);
        key_ = key_of(image, state_);
        pending_ = {};
        sent_ = false;
    }

    /// The next order of a true term, in table order; nothing once all terms have been evaluated.
    std::optional<MotorOrder> next() {
        while (range_.begin != range_.end) {
            const TermView term = table_->term(range_.begin++);
            if (step_of(term) != state_.step || !is_true(term, key_)) continue;
            if (!is_flex(term)) pending_.fold(term);
            if (has_order(term)) {
                sent_ = true;
                return order_of(term);
            }
        }
        return std::nullopt;
    }

    ScanEffect finish() {
        const bool changed = apply(pending_, state_);
        return {.changed = changed, .sent = sent_, .timer_preset = pending_.timer_preset != 0};
    }

    void elapse(std::uint32_t milliseconds) { sequencer::elapse(state_, milliseconds); }

    Key key(InputImage image) const { return key_of(image, state_); }

    /// Steps 1 to 3 at once, for a motor that never halts the scan. `sink(const MotorOrder&)` is called in
    /// table order. A loop of its own because it keeps what a halted scan must remember in registers.
    template <class Sink>
    ScanEffect scan(InputImage image, Sink&& sink) {
        const Table::Range range = table_->terms_of(state_.step);
        const Key key = key_of(image, state_);
        Pending pending;
        bool sent = false;
        for (std::uint16_t i = range.begin; i != range.end; ++i) {
            const TermView term = table_->term(i);
            if (step_of(term) != state_.step || !is_true(term, key)) continue;
            if (!is_flex(term)) pending.fold(term);
            if (has_order(term)) {
                sent = true;
                sink(order_of(term));
            }
        }
        const bool changed = apply(pending, state_);
        return {.changed = changed, .sent = sent, .timer_preset = pending.timer_preset != 0};
    }

  private:
    const Table* table_;
    State state_;
    Table::Range range_;
    Key key_ = 0;
    bool sent_ = false;
    Pending pending_;
};

}  // namespace nplc::sequencer
