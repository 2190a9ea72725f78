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

    static bool has_order(TermView term) { return (term[2] & 0x80) != 0 || (term[4] & 0x80) == 0; }

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
            if ((table.term(i)[0] & 0x3F) == step) own[own_count++] = i;
        }
    }

    /// The ten bits as a term wants them.
    static Filter filter_of(TermView term) {
        const unsigned zeros =
            ((term[0] & 0x80U) == 0 ? 0x100U : 0U) | ((term[0] & 0x40U) == 0 ? 0x200U : 0U);
        const unsigned care = (term[2] & 0x7FU) | kError | zeros;
        return {.care = static_cast<Key>(care), .want = static_cast<Key>((term[1] | zeros) & care)};
    }

    Filter common_filter() const {
        if (own_count == 0) return {};
        Filter common = filter_of(table.term(own[0]));
        for (std::size_t i = 1; i != own_count; ++i) {
            const Filter other = filter_of(table.term(own[i]));
            common.care = static_cast<Key>(common.care & other.care & ~(common.want ^ other.want));
        }
        return common;
    }

    Action outcome(Key key) const {
        Action action;
        each_true(key, [&](TermView term) {
            if ((term[2] & 0x80) == 0) action.pending.fold(term);
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
        filters_[step] = fill.common_filter();
    }
    storage_ = storage;
    actions_used_ = fill.actions;
    orders_used_ = fill.orders;
    return {};
}

}  // namespace nplc::sequencer
