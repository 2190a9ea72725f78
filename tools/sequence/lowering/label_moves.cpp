// How LabelSearch finds the candidate terms for the next position, and places one.
#include <algorithm>
#include <numeric>

#include "lowering/label_search.h"

namespace nplc::seqc {
namespace {

/// Kinds of terms without an order in a region: with or without a next step, with or without a preset.
enum MoveKind : std::uint8_t {
    kNamed = 1,
    kNamedTimer = 2,
    kNamedCounter = 4,
    kUnnamed = 8,
    kUnnamedTimer = 16,
    kUnnamedCounter = 32,
};
constexpr std::uint8_t kAnyNamed = kNamed | kNamedTimer | kNamedCounter;
constexpr std::uint8_t kAnyTimer = kNamedTimer | kUnnamedTimer;
constexpr std::uint8_t kAnyCounter = kNamedCounter | kUnnamedCounter;

/// Inlined because it is evaluated for every cube.
inline std::uint8_t kinds_in(RemainingEffects open, const OpenLayout& layout, bool unnamed_help) {
    if (!at_most_one(open & layout.outputs)) return 0;
    const bool named = at_most_one(open & layout.nexts);
    if (!named && !unnamed_help) return 0;
    const auto presets = [&](RemainingEffects group, RemainingEffects none) {
        return (open & none) == 0 && (open & group) != 0 && at_most_one(open & group);
    };
    unsigned kinds = (open & (named ? layout.nexts | layout.outputs : layout.outputs)) != 0 ? kNamed : 0;
    if (presets(layout.timers, layout.no_timer)) kinds |= kNamedTimer;
    if (presets(layout.counters, layout.no_counter)) kinds |= kNamedCounter;
    return static_cast<std::uint8_t>(named ? kinds : kinds << 3U);
}

}  // namespace

LabelSearch::Kinds LabelSearch::kinds_of(RemainingEffects open) const {
    return kinds_in(open, layout_, unnamed_help_);
}

RemainingEffects LabelSearch::cleared_by(Kinds kind) const {
    RemainingEffects bits = layout_.outputs;
    if ((kind & kAnyNamed) != 0) bits |= layout_.nexts;
    if ((kind & kAnyTimer) != 0) bits |= layout_.timers;
    if ((kind & kAnyCounter) != 0) bits |= layout_.counters;
    return bits;
}

/// Computes all open bits of each cube, from the points up.
void LabelSearch::survey(const State& state) {
    const std::size_t size = cubes_.size();
    const std::size_t points = std::size_t{1} << inputs();
    for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
        RemainingEffects* layer = &masks_[zeros * size];
        for (std::size_t point = 0; point < points; ++point)
            layer[cubes_.point(point)] = state.open[zeros * points + point];
        cubes_.unite(layer);
    }
    for (std::size_t bit = 1; bit < layers_; bit *= 2) {
        for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
            if ((zeros & bit) != 0) continue;
            for (std::size_t index = 0; index < size; ++index)
                masks_[zeros * size + index] |= masks_[(zeros | bit) * size + index];
        }
    }
    const OpenLayout layout = layout_;
    for (std::size_t i = 0; i < masks_.size(); ++i) kinds_[i] = kinds_in(masks_[i], layout, unnamed_help_);
    work_ += masks_.size();
}

/// Only maximal regions of a kind are candidates.
std::vector<LabelSearch::Candidate> LabelSearch::candidates(const State& state) {
    survey(state);
    const std::size_t size = cubes_.size();
    std::vector<Kinds> widest = kinds_;
    std::vector<Candidate> list;
    for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
        Kinds* layer = &widest[zeros * size];
        cubes_.remove_wider(&kinds_[zeros * size], layer);
        for (std::size_t bit = 1; bit < layers_; bit *= 2) {
            if ((zeros & bit) == 0) continue;
            const Kinds* below = &kinds_[(zeros & ~bit) * size];
            for (std::size_t i = 0; i < size; ++i) layer[i] = static_cast<Kinds>(layer[i] & ~below[i]);
        }
        for (std::size_t i = 0; i < size; ++i) {
            if (layer[i] != 0) add_candidates(state, cube_of(cubes_[i]), zeros, layer[i], list);
        }
    }
    remove_dominated(list);
    return list;
}

void LabelSearch::add_candidates(const State& state, Cube cube, std::size_t zeros, Kinds kinds,
                                 std::vector<Candidate>& list) {
    const Region region{cube.value, cube.care, static_cast<std::uint8_t>(zeros)};
    const CaseSet cases = set_of(region);
    for (unsigned kind = 1; kind <= kinds; kind *= 2) {
        if ((kinds & kind) == 0) continue;
        const auto one = static_cast<Kinds>(kind);
        const CaseSet gains = gains_of(state, cases, one);
        list.push_back({region, one, gains, worth(state, cases, one)});
    }
}

CaseSet LabelSearch::gains_of(const State& state, const CaseSet& cases, Kinds kind) const {
    CaseSet gains = (kind & kAnyNamed) != 0 ? state.nexts : state.outputs;
    if ((kind & kAnyTimer) != 0) gains |= state.timers;
    if ((kind & kAnyCounter) != 0) gains |= state.counters;
    return gains &= cases;
}

/// Number of decisions in `cases`: next steps, outputs, presets.
std::size_t LabelSearch::worth(const State& state, const CaseSet& cases, Kinds kind) const {
    const auto count = [&](CaseSet open) { return (open &= cases).size(); };
    std::size_t total = count(state.outputs);
    if ((kind & kAnyNamed) != 0) total += count(state.nexts);
    if ((kind & kAnyTimer) != 0) total += count(state.timers);
    if ((kind & kAnyCounter) != 0) total += count(state.counters);
    return total;
}

/// Keeps the candidates that are not dominated, those that decide most first.
void LabelSearch::remove_dominated(std::vector<Candidate>& list) const {
    std::vector<std::uint32_t> order(list.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return list[a].gain > list[b].gain; });
    std::vector<Candidate> kept;
    for (std::uint32_t i : order) {
        const Candidate& narrow = list[i];
        const bool useless = std::any_of(kept.begin(), kept.end(), [&](const Candidate& wide) {
            return narrow.gains.is_within(wide.gains) &&
                   (cleared_by(narrow.kind) & ~cleared_by(wide.kind)) == 0;
        });
        if (!useless) kept.push_back(narrow);
    }
    list = std::move(kept);
}

void LabelSearch::place(State& state, const Region& region, Kinds kind, const OrderTerm* order) {
    PlacedTerm term;
    term.region = region;
    term.order = order;
    term.names_next = (kind & kAnyNamed) != 0;
    term.preset = (kind & kAnyTimer) != 0     ? Preset::timer
                  : (kind & kAnyCounter) != 0 ? Preset::counter
                                              : Preset::none;
    if (order != nullptr && !order->is_fast()) {
        path_.push_back(term);
        return;
    }
    const RemainingEffects cleared = cleared_by(kind);
    const CaseSet cases = set_of(region);
    bool first = true;
    cases.for_each([&](std::size_t c) {
        const Behaviour& wanted = error_branch_.at(c);
        const RemainingEffects open = state.open[c];
        if (first || (open & layout_.nexts) != 0) term.next = wanted.next;
        if (first || (open & layout_.outputs) != 0) term.output_byte = wanted.output_byte();
        if (term.preset == Preset::timer && (first || (open & layout_.timers) != 0))
            term.value = wanted.timer();
        if (term.preset == Preset::counter && (first || (open & layout_.counters) != 0))
            term.value = wanted.counter();
        first = false;
        state.open[c] &= ~cleared;
    });
    state.outputs.remove(cases);
    if (term.names_next) state.nexts.remove(cases);
    if (term.preset == Preset::timer) state.timers.remove(cases);
    if (term.preset == Preset::counter) state.counters.remove(cases);
    path_.push_back(term);
}

/// Places every order whose term may have what its cases still need.
void LabelSearch::place_items(State& state) {
    bool changed = true;
    while (changed && state.left != 0) {
        changed = false;
        for (std::size_t i = items_.size(); i-- > 0;) {
            const Item& item = items_[i];
            if (state.placed[i] != 0 || !may_place(state, item)) continue;
            const Kinds kind = item.term->preset == Preset::timer     ? kNamedTimer
                               : item.term->preset == Preset::counter ? kNamedCounter
                                                                      : kNamed;
            place(state, item.term->region, kind, item.term);
            state.placed[i] = 1;
            --state.left;
            changed = true;
        }
    }
}

bool LabelSearch::may_place(const State& state, const Item& item) const {
    for (std::uint32_t later : item.after) {
        if (state.placed[later] == 0) return false;
    }
    if (!item.term->is_fast()) return true;
    RemainingEffects open = 0;
    item.cases.for_each([&](std::size_t c) { open |= state.open[c]; });
    return at_most_one(open & layout_.outputs) && at_most_one(open & layout_.nexts);
}

}  // namespace nplc::seqc
