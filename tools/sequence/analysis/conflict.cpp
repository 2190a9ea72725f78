#include "conflict.h"

#include <algorithm>

namespace nplc::verify {

void Conflict::join(const Conflict& other) {
    first = std::min(first, other.first);
    last = std::max(last, other.last);
    exact = exact || other.exact;
    overdue = overdue || other.overdue;
}

void Excluded::forget() {
    states_ = {{}};
    state_numbers_ = {{Items{}, 0}};
    known_.clear();
}

Excluded::Symbol Excluded::symbol_of(const CourseScan& scan) {
    const Group& group = *scan.group;
    const bool is_seen_moving = is_timed(scan.place.motion) && !group.in_pos && !group.disturbs;
    const unsigned flags = (scan.idle ? 1U : 0U) | (scan.place.runs ? 2U : 0U) | (scan.next_runs ? 4U : 0U) |
                           (is_seen_moving ? 8U : 0U) | (begins_move(group.outcome.orders) ? 16U : 0U);
    const TimesKey times{scan.delay.least, scan.delay.most, group.delay.end, group.outcome.timer, flags};
    const ExactKey exact{scan.place.packed(), group.number, (scan.next_runs ? 1U << 16U : 0U) | scan.counter,
                         scan.delay.most};
    return {times_.try_emplace(times, static_cast<std::uint32_t>(times_.size())).first->second,
            exact_.try_emplace(exact, static_cast<std::uint32_t>(exact_.size())).first->second, scan.begins};
}

const Excluded::Symbol& Excluded::symbol_of(const Explorer::Edge& edge) {
    if (symbols_.empty()) symbols_.resize(explorer_.edges().size());
    Symbol& symbol = symbols_[static_cast<std::size_t>(&edge - explorer_.edges().data())];
    if (symbol.times == kWhatever) symbol = symbol_of(explorer_.scan_of(edge, {}));
    return symbol;
}

void Excluded::add(std::span<const CourseScan> scans, const Conflict& conflict) {
    Pattern pattern;
    pattern.at_end = conflict.overdue;
    for (std::size_t k = conflict.first; k <= conflict.last; ++k) {
        const Symbol symbol = symbol_of(scans[k]);
        pattern.elements.push_back(
            {symbol.times, conflict.exact ? symbol.exact : kWhatever, conflict.overdue && symbol.begins});
    }
    if (std::find(patterns_.begin(), patterns_.end(), pattern) != patterns_.end()) return;
    patterns_.push_back(std::move(pattern));
    forget();
}

Excluded::State Excluded::state_of(Items items) {
    std::sort(items.begin(), items.end());
    const auto [found, is_new] = state_numbers_.try_emplace(items, static_cast<State>(states_.size()));
    if (is_new) states_.push_back(std::move(items));
    return found->second;
}

Excluded::State Excluded::next(State before, const Symbol& symbol, bool is_end) {
    const std::uint64_t key = (std::uint64_t{before} << 34U) | (std::uint64_t{symbol.exact} << 2U) |
                              (symbol.begins ? 2U : 0U) | (is_end ? 1U : 0U);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    Items items = states_[before];
    count_work(patterns_.size() / 8);
    for (std::uint32_t pattern = 0; pattern < patterns_.size(); ++pattern) items.emplace_back(pattern, 0);
    Items then;
    for (const auto& [number, matched] : items) {
        const Pattern& pattern = patterns_[number];
        const Element& wanted = pattern.elements[matched];
        if (wanted.times != symbol.times || (wanted.exact != kWhatever && wanted.exact != symbol.exact) ||
            (wanted.begins && !symbol.begins))
            continue;
        const bool is_whole = matched + 1 == pattern.elements.size();
        if (is_whole && (is_end || !pattern.at_end)) return known_[key] = kOut;
        if (!is_whole) then.emplace_back(number, matched + 1);
    }
    return known_[key] = state_of(std::move(then));
}

Excluded::State Excluded::next(State before, const Explorer::Edge& edge, bool begins) {
    Symbol symbol = symbol_of(edge);
    symbol.begins = begins;
    return next(before, symbol, false);
}

Excluded::State Excluded::next(State before, const CourseScan& scan) {
    return next(before, symbol_of(scan), false);
}

bool Excluded::ends_out(State before, const Explorer::Edge& edge, bool begins) {
    Symbol symbol = symbol_of(edge);
    symbol.begins = begins;
    return next(before, symbol, true) == kOut;
}

}  // namespace nplc::verify
