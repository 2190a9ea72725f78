#include "sequencer/prepared.h"

#include <algorithm>

namespace nplc::sequencer {

/// Fills a Storage front to back.
struct PreparedTable::Fill {
    const Table& table;
    const Storage& storage;
    std::size_t actions = 0;
    std::size_t orders = 0;

    bool collect(std::uint8_t step, Key key, Action& action) {
        action.first_order = static_cast<std::uint32_t>(orders);
        std::size_t end = orders;
        const Table::Range range = table.terms_of(step);
        for (std::size_t i = range.begin; i != range.end; ++i) {
            const TermView term = table.term(i);
            if ((term[0] & 0x3F) != step || !is_true(term, key)) continue;
            const bool is_flex = (term[2] & 0x80) != 0;
            if (!is_flex) action.pending.fold(term);
            if (!is_flex && (term[4] & 0x80) != 0) continue;
            if (end == storage.orders.size()) return false;
            storage.orders[end++] = order_of(term);
        }
        action.order_count = static_cast<std::uint16_t>(end - orders);
        return true;
    }

    bool same(const Action& a, const Action& b) const {
        return a.pending == b.pending && a.order_count == b.order_count &&
               std::equal(&storage.orders[a.first_order], &storage.orders[a.first_order] + a.order_count,
                          &storage.orders[b.first_order]);
    }

    /// Index of `action`, which is stored if the step has none like it yet. Nothing when there is no room.
    std::size_t intern(const Action& action, std::size_t first_of_step) {
        for (std::size_t i = first_of_step; i < actions; ++i) {
            if (same(storage.actions[i], action)) return i;
        }
        if (actions == storage.actions.size() || actions > 0xFFFF) return storage.actions.size();
        orders += action.order_count;
        storage.actions[actions] = action;
        return actions++;
    }

    bool step(std::uint8_t step) {
        const std::size_t first_of_step = actions;
        for (Key key = 0; key < kKeys; ++key) {
            Action action;
            if (!collect(step, key, action)) return false;
            const std::size_t index = intern(action, first_of_step);
            if (index == storage.actions.size()) return false;
            storage.cells[step * kKeys + key] = static_cast<std::uint16_t>(index);
        }
        return true;
    }
};

base::Status PreparedTable::prepare(const Table& table, const Storage& storage) {
    if (storage.cells.size() < kCells) return base::Error::no_space;
    Fill fill{table, storage};
    for (std::uint8_t step = 0; step <= kLastStep; ++step) {
        if (!fill.step(step)) return base::Error::no_space;
    }
    storage_ = storage;
    return {};
}

}  // namespace nplc::sequencer
