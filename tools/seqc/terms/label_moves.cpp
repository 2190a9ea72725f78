// How LabelSearch finds the terms that may stand next, and places one.
#include <algorithm>
#include <bit>

#include "terms/label_search.h"

namespace nplc::seqc {
namespace {

/// What a term without an order may be in a region: with or without a next step, with or without a preset.
enum Kind : std::uint8_t {
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

bool at_most_one(OpenBits bits) {
    return (bits & (bits - 1)) == 0;
}

}  // namespace

LabelSearch::Kinds LabelSearch::kinds_of(OpenBits open) const {
    if (!at_most_one(open & layout_.outputs)) return 0;
    const bool named = at_most_one(open & layout_.nexts);
    if (!named && !unnamed_help_) return 0;
    const auto presets = [&](OpenBits group, OpenBits none) {
        return (open & none) == 0 && (open & group) != 0 && at_most_one(open & group);
    };
    unsigned kinds = (open & (layout_.nexts | layout_.outputs)) != 0 ? kNamed : 0;
    if (presets(layout_.timers, layout_.no_timer)) kinds |= kNamedTimer;
    if (presets(layout_.counters, layout_.no_counter)) kinds |= kNamedCounter;
    if (!named && (open & layout_.outputs) == 0) kinds &= ~static_cast<unsigned>(kNamed);
    return static_cast<Kinds>(named ? kinds : kinds << 3U);
}

OpenBits LabelSearch::cleared_by(Kinds kind) const {
    OpenBits bits = layout_.outputs;
    if ((kind & kAnyNamed) != 0) bits |= layout_.nexts;
    if ((kind & kAnyTimer) != 0) bits |= layout_.timers;
    if ((kind & kAnyCounter) != 0) bits |= layout_.counters;
    return bits;
}

/// All that is open in each cube, from the points up.
void LabelSearch::survey(const State& state) {
    const std::size_t size = cubes_.size();
    for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
        OpenBits* layer = &masks_[zeros * size];
        for (std::size_t index = 0; index < size; ++index) {
            const Ternary::Entry& cube = cubes_[index];
            layer[index] = cube.is_point ? state.open[zeros << inputs() | cube.value]
                                         : layer[cube.low] | layer[cube.high];
        }
    }
    for (std::size_t bit = 1; bit < layers_; bit *= 2) {
        for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
            if ((zeros & bit) != 0) continue;
            for (std::size_t index = 0; index < size; ++index)
                masks_[zeros * size + index] |= masks_[(zeros | bit) * size + index];
        }
    }
    for (std::size_t i = 0; i < masks_.size(); ++i) kinds_[i] = kinds_of(masks_[i]);
    work_ += masks_.size();
}

std::vector<LabelSearch::Candidate> LabelSearch::candidates(const State& state) {
    survey(state);
    std::vector<Candidate> list;
    for (std::size_t zeros = 0; zeros < layers_; ++zeros) {
        for (std::size_t index = 0; index < cubes_.size(); ++index) {
            if (kinds_[zeros * cubes_.size() + index] != 0) add_candidates(state, index, zeros, list);
        }
    }
    const auto better = [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; };
    std::stable_sort(list.begin(), list.end(), better);
    remove_dominated(state, list);
    return list;
}

/// Only the widest regions of a kind are worth a term.
void LabelSearch::add_candidates(const State& state, std::size_t index, std::size_t zeros,
                                 std::vector<Candidate>& list) {
    const std::size_t size = cubes_.size();
    unsigned kinds = kinds_[zeros * size + index];
    const Ternary::Entry& cube = cubes_[index];
    for (std::size_t v = 0; v < inputs() && kinds != 0; ++v) {
        if (((cube.care >> v) & 1U) != 0) kinds &= ~unsigned{kinds_[zeros * size + cubes_.without(index, v)]};
    }
    for (std::size_t bit = 1; bit < layers_; bit *= 2) {
        if ((zeros & bit) != 0) kinds &= ~unsigned{kinds_[(zeros & ~bit) * size + index]};
    }
    const Region region{cube.value, cube.care, static_cast<std::uint8_t>(zeros)};
    for (unsigned kind = 1; kind <= kinds; kind *= 2) {
        if ((kinds & kind) == 0) continue;
        const auto one = static_cast<Kinds>(kind);
        list.push_back({region, one, gain_of(state, region, one)});
    }
}

std::size_t LabelSearch::gain_of(const State& state, const Region& region, Kinds kind) const {
    const OpenBits cleared = cleared_by(kind);
    std::size_t gain = 0;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        if (region.holds(c, inputs()))
            gain += static_cast<std::size_t>(std::popcount(state.open[c] & cleared));
    }
    return gain;
}

bool LabelSearch::dominates(const State& state, const Candidate& wide, const Candidate& narrow) const {
    const OpenBits by_narrow = cleared_by(narrow.kind);
    const OpenBits by_wide = cleared_by(wide.kind);
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        const OpenBits gained = state.open[c] & by_narrow;
        if (gained == 0 || !narrow.region.holds(c, inputs())) continue;
        if ((gained & ~by_wide) != 0 || !wide.region.holds(c, inputs())) return false;
    }
    return true;
}

void LabelSearch::remove_dominated(const State& state, std::vector<Candidate>& list) const {
    std::vector<Candidate> kept;
    for (const Candidate& candidate : list) {
        const bool useless = std::any_of(kept.begin(), kept.end(), [&](const Candidate& wide) {
            return dominates(state, wide, candidate);
        });
        if (!useless) kept.push_back(candidate);
    }
    list = std::move(kept);
}

void LabelSearch::place(State& state, const Region& region, Kinds kind, const OrderTerm* order) {
    PlacedTerm term;
    term.region = region;
    term.order = order;
    term.names_next = (kind & kAnyNamed) != 0;
    const OpenBits cleared = order != nullptr && !order->is_fast() ? 0 : cleared_by(kind);
    term.preset = (kind & kAnyTimer) != 0     ? Preset::timer
                  : (kind & kAnyCounter) != 0 ? Preset::counter
                                              : Preset::none;
    bool first = true;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        if (!region.holds(c, inputs())) continue;
        const Behaviour& wanted = half_.at(c);
        const OpenBits open = state.open[c];
        if (first || (open & layout_.nexts) != 0) term.next = wanted.next;
        if (first || (open & layout_.outputs) != 0) term.output_byte = wanted.output_byte();
        if (term.preset == Preset::timer && (first || (open & layout_.timers) != 0))
            term.value = wanted.timer();
        if (term.preset == Preset::counter && (first || (open & layout_.counters) != 0))
            term.value = wanted.counter();
        first = false;
        state.open[c] &= ~cleared;
    }
    path_.push_back(std::move(term));
}

/// Places every order whose term may carry what its cases still want.
void LabelSearch::place_items(State& state) {
    bool changed = true;
    while (changed && state.left != 0) {
        changed = false;
        for (std::size_t i = items_.size(); i-- > 0;) {
            const Item& item = items_[i];
            Kinds kind = 0;
            if (state.placed[i] != 0 || !may_place(state, item, kind)) continue;
            place(state, item.term->region, kind, item.term);
            for (std::uint16_t c : item.cases) --state.to_send[c];
            state.placed[i] = 1;
            --state.left;
            changed = true;
        }
    }
}

bool LabelSearch::may_place(const State& state, const Item& item, Kinds& kind) const {
    OpenBits open = 0;
    for (std::size_t k = 0; k < item.cases.size(); ++k) {
        if (state.to_send[item.cases[k]] != item.rank[k] + 1) return false;
        open |= state.open[item.cases[k]];
    }
    if (!item.term->is_fast()) {
        kind = kNamed;
        return true;
    }
    kind = item.term->preset == Preset::timer     ? kNamedTimer
           : item.term->preset == Preset::counter ? kNamedCounter
                                                  : kNamed;
    return at_most_one(open & layout_.outputs) && at_most_one(open & layout_.nexts);
}

}  // namespace nplc::seqc
