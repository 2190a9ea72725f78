#include "sequencer/prepared.h"

#include <array>

namespace nplc::sequencer {

/// Fills a Storage front to back, step by step.
struct PreparedTable::Fill {
    const Table& table;
    const Storage& storage;
    std::size_t actions = 0;
    std::size_t orders = 0;
    std::array<std::uint16_t, kMaxTerms> own{};  ///< the terms of the step in hand
    std::size_t own_count = 0;

    /// Calls `visit(term)` for each true term until it answers false.
    template <class Visit>
    bool each_true(Key key, Visit&& visit) const {
        for (std::size_t i = 0; i != own_count; ++i) {
            const TermView term = table.term(own[i]);
            if (is_true(term, key) && !visit(term)) return false;
        }
        return true;
    }

    void list_own_terms(std::uint8_t step) {
        own_count = 0;
        const Table::Range range = table.terms_of(step);
        for (std::uint16_t i = range.begin; i != range.end; ++i) {
            if (step_of(table.term(i)) == step) own[own_count++] = i;
        }
    }

    Action outcome(Key key) const {
        Action action;
        each_true(key, [&](TermView term) {
            if (!is_flex(term)) action.pending.fold(term);
            if (has_order(term)) ++action.order_count;
            return true;
        });
        return action;
    }

    bool sends(Key key, const Action& stored) const {
        std::size_t next = stored.first_order;
        return each_true(
            key, [&](TermView term) { return !has_order(term) || storage.orders[next++] == order_of(term); });
    }

    bool same(const Action& stored, const Action& action, Key key) const {
        return stored.pending == action.pending && stored.order_count == action.order_count &&
               (action.order_count == 0 || sends(key, stored));
    }

    bool store(Action action, Key key) {
        if (actions == storage.actions.size()) return false;
        if (storage.orders.size() - orders < action.order_count) return false;
        action.first_order = static_cast<std::uint32_t>(orders);
        each_true(key, [&](TermView term) {
            if (has_order(term)) storage.orders[orders++] = order_of(term);
            return true;
        });
        storage.actions[actions++] = action;
        return true;
    }

    bool fill_step(std::uint8_t step) {
        list_own_terms(step);
        const auto cells = storage.cells.subspan(step * kKeys, kKeys);
        const std::size_t first_of_step = actions;
        for (Key key = 0; key < kKeys; ++key) {
            const Action action = outcome(key);
            std::size_t index = kNothing;
            if (!same(storage.actions[kNothing], action, key)) {
                index = first_of_step;
                while (index != actions && !same(storage.actions[index], action, key)) ++index;
                if (index == actions && !store(action, key)) return false;
            }
            cells[key] = static_cast<std::uint16_t>(index);
        }
        return true;
    }
};

base::Status PreparedTable::prepare(const Table& table, const Storage& storage) {
    if (storage.cells.size() < kCells || storage.actions.empty()) return base::Error::no_space;
    Fill fill{.table = table, .storage = storage};
    storage.actions[kNothing] = {};
    fill.actions = 1;
    for (std::uint8_t step = 0; step <= kLastStep; ++step) {
        if (!fill.fill_step(step)) return base::Error::no_space;
    }
    storage_ = storage;
    actions_used_ = fill.actions;
    orders_used_ = fill.orders;
    return {};
}

}  // namespace nplc::sequencer
