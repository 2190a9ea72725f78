#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "sequencer/engine.h"

namespace nplc::sequencer {

/// A Table worked out in advance for all 1024 keys of every step: a scan is two look-ups, however many terms
/// a step has. It lives in storage of the caller's (about 130 kB for a full table), for hosts where that is
/// no concern.
class PreparedTable {
  public:
    /// What all true terms of one step under one key amount to.
    struct Action {
        Pending pending;
        std::uint16_t order_count = 0;
        std::uint32_t first_order = 0;  ///< in Storage::orders
    };

    struct Storage {
        std::span<std::uint16_t> cells;  ///< 63 x kKeys; index of an action
        std::span<Action> actions;       ///< "nothing", and one for each different outcome of a step
        std::span<MotorOrder> orders;    ///< those of all actions
    };
    static constexpr std::size_t kCells = 63 * kKeys;
    static constexpr std::size_t kMaxActions = kCells + 1;  ///< no table needs more

    /// Fails with no_space when a span is too short; then the storage holds nothing of use. On success the
    /// storage belongs to this object; `table` is no longer needed.
    base::Status prepare(const Table& table, const Storage& storage);

    std::size_t actions_used() const { return actions_used_; }
    std::size_t orders_used() const { return orders_used_; }

    /// Where the 256 cells of a state begin, one for each image. `state.step` is 0..62.
    static std::uint32_t row_of(const State& state) {
        return static_cast<std::uint32_t>(state.step * kKeys + key_of(0, state));
    }

    /// What every term of a step asks for, so that most scans end with one comparison.
    struct Filter {
        Key care = 0;
        Key want = 0;
        bool stops(std::uint32_t key) const { return ((key ^ want) & care) != 0; }
    };
    const Filter& filter(std::uint8_t step) const { return filters_[step]; }

    /// What a scan in a state of `row` does; null if nothing. Only after a prepare() that did not fail.
    const Action* find(std::uint32_t row, InputImage image) const {
        const std::uint16_t index = storage_.cells[row + image];
        return index == kNothing ? nullptr : &storage_.actions[index];
    }
    std::span<const MotorOrder> orders(const Action& action) const {
        return storage_.orders.subspan(action.first_order, action.order_count);
    }

  private:
    struct Fill;
    static constexpr std::size_t kNothing = 0;  ///< index of the action that all steps share

    Storage storage_;
    std::array<Filter, 64> filters_{};
    std::size_t actions_used_ = 0;
    std::size_t orders_used_ = 0;
};

/// Engine's scan on a PreparedTable; the same state, effects and orders.
class PreparedEngine {
  public:
    /// `table` must be prepared already.
    explicit PreparedEngine(const PreparedTable& table) : table_(&table) { reset(); }

    void reset() { restore({}); }

    /// Goes on from `state` (step 0..62).
    void restore(const State& state) {
        state_ = state;
        find_row();
    }
    const State& state() const { return state_; }

    template <class Sink>
    ScanEffect scan(InputImage image, Sink&& sink) {
        if (filter_.stops(row_ | image)) return {};
        const PreparedTable::Action* action = table_->find(row_, image);
        if (action == nullptr) return {};
        for (const MotorOrder& order : table_->orders(*action)) sink(order);
        const bool changed = apply(action->pending, state_);
        find_row();
        return {.changed = changed,
                .sent = action->order_count != 0,
                .timer_preset = action->pending.timer_preset != 0};
    }

    void elapse(std::uint32_t milliseconds) {
        if (state_.timer == 0) return;
        sequencer::elapse(state_, milliseconds);
        if (state_.timer == 0) find_row();
    }

  private:
    void find_row() {
        row_ = PreparedTable::row_of(state_);
        filter_ = table_->filter(state_.step);
    }

    const PreparedTable* table_;
    State state_;
    PreparedTable::Filter filter_;  ///< of state_, like row_; kept, not worked out in each scan
    std::uint32_t row_ = 0;
};

}  // namespace nplc::sequencer
