#include "lowering/label_search.h"

#include <algorithm>
#include <bit>

namespace nplc::seqc {

template <class T>
RemainingEffects OpenLayout::bit_for(std::vector<T>& seen, std::vector<RemainingEffects>& bits, T value,
                                     RemainingEffects& group) {
    const auto found = std::find(seen.begin(), seen.end(), value);
    if (found != seen.end()) return bits[static_cast<std::size_t>(found - seen.begin())];
    fits_ = fits_ && used_ < 62;
    const RemainingEffects bit = RemainingEffects{1} << (fits_ ? used_++ : 0);
    seen.push_back(value);
    bits.push_back(bit);
    group |= bit;
    return bit;
}

OpenLayout::OpenLayout(const ReducedStep& error_branch) {
    std::vector<std::uint8_t> next_values;
    std::vector<std::uint8_t> output_values;
    std::vector<std::uint16_t> timer_values;
    std::vector<std::uint16_t> counter_values;
    std::array<std::vector<RemainingEffects>, 4> bits;
    no_timer = RemainingEffects{1} << 62;
    no_counter = RemainingEffects{1} << 63;
    for (const Behaviour& behaviour : error_branch.behaviours) {
        const RemainingEffects next = bit_for(next_values, bits[0], behaviour.next, nexts);
        const RemainingEffects output = bit_for(output_values, bits[1], behaviour.output_byte(), outputs);
        RemainingEffects presets = 0;
        RemainingEffects none = no_timer | no_counter;
        if (behaviour.timer() != 0) {
            presets |= bit_for(timer_values, bits[2], behaviour.timer(), timers);
            none &= ~no_timer;
        }
        if (behaviour.counter() != 0) {
            presets |= bit_for(counter_values, bits[3], behaviour.counter(), counters);
            none &= ~no_counter;
        }
        wanted_.push_back(next | output | presets | none);
        demanded_.push_back((behaviour.leaves ? next : 0) | (behaviour.writes ? output : 0) | presets);
    }
}

namespace {

constexpr std::size_t kWorkForOrders = 100'000;  // cubes examined
constexpr std::size_t kWorkInAll = 300'000;
constexpr std::size_t kRemembered = 1'024;
constexpr std::size_t kShallow = 2;
constexpr std::size_t kMostClasses = 16;

}  // namespace

LabelSearch::LabelSearch(const ReducedStep& error_branch, const OrderPlan& plan)
    : error_branch_(error_branch),
      cubes_(Ternary::of(error_branch.inputs)),
      layout_(error_branch),
      layers_(error_branch.cases() >> error_branch.inputs) {
    std::vector<std::pair<std::uint8_t, std::uint8_t>> seen;
    std::vector<std::size_t> class_of;
    for (const Behaviour& behaviour : error_branch.behaviours) {
        const std::pair key{behaviour.next, behaviour.output_byte()};
        const auto found = std::find(seen.begin(), seen.end(), key);
        class_of.push_back(static_cast<std::size_t>(found - seen.begin()));
        if (found != seen.end()) continue;
        for (const auto& other : seen) unnamed_help_ = unnamed_help_ || other.second == key.second;
        seen.push_back(key);
    }
    unnamed_help_ = unnamed_help_ && !at_most_one(layout_.outputs);

    const CaseSet none(error_branch.cases());
    classes_.assign(seen.size(), none);
    start_.nexts = start_.outputs = start_.timers = start_.counters = none;
    for (std::size_t c = 0; c < error_branch.cases(); ++c) {
        classes_[class_of[error_branch.wanted[c]]].insert(c);
        const RemainingEffects open = layout_.wanted(error_branch.wanted[c]);
        start_.open.push_back(open);
        start_.nexts.insert(c);
        start_.outputs.insert(c);
        if ((open & layout_.timers) != 0) start_.timers.insert(c);
        if ((open & layout_.counters) != 0) start_.counters.insert(c);
        demanded_.push_back(layout_.demanded(error_branch.wanted[c]));
    }
    for (const OrderTerm& term : plan) items_.push_back({&term, set_of(term.region), {}});
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
        for (std::uint32_t j = i + 1; j < items_.size(); ++j) {
            CaseSet both = items_[i].cases;
            if (!(both &= items_[j].cases).is_empty()) items_[i].after.push_back(j);
        }
    }
    start_.placed.assign(items_.size(), 0);
    start_.left = items_.size();
}

std::optional<std::vector<PlacedTerm>> LabelSearch::run(std::size_t limit) {
    if (!layout_.fits()) return std::nullopt;
    best_used_ = limit + 1;
    masks_.resize(layers_ * cubes_.size());
    kinds_.resize(masks_.size());
    most_work_ = kWorkInAll;
    State state = start_;
    place_items(state);
    const std::size_t least = bound(start_);
    const std::size_t shallow = std::min(limit, std::max(least, kShallow));
    if (!search_up_to(state, least, shallow) && limit > shallow) {
        most_work_ = work_ + kWorkForOrders;
        if (classes_.size() <= kMostClasses) try_orders(state, (1U << classes_.size()) - 1U, 0);
        most_work_ = kWorkInAll;
        search_up_to(state, shallow + 1, limit);
    }
    if (best_used_ > limit) return std::nullopt;
    return result();
}

/// Whether some number of terms from `first` on is enough; the first such number is the minimum.
bool LabelSearch::search_up_to(const State& state, std::size_t first, std::size_t last) {
    for (std::size_t most = first; most <= last && most < best_used_ && work_ <= most_work_; ++most) {
        failed_.assign(kRemembered, {0, 0});
        if (search(state, most, 0)) return true;
    }
    return false;
}

bool LabelSearch::is_done(const State& state) const {
    if (state.left != 0 || !state.timers.is_empty() || !state.counters.is_empty()) return false;
    bool done = true;
    state.nexts.for_each([&](std::size_t c) { done = done && (state.open[c] & demanded_[c]) == 0; });
    return done;
}

/// Lower bound: every next step, output byte and preset that no order can carry takes a term.
std::size_t LabelSearch::bound(const State& state) const {
    CaseSet open = state.nexts;
    open |= state.timers;
    open |= state.counters;
    for (std::size_t i = 0; i < items_.size() && state.left != 0; ++i) {
        if (state.placed[i] == 0 && items_[i].term->is_fast()) open.remove(items_[i].cases);
    }
    RemainingEffects bits = 0;
    open.for_each([&](std::size_t c) { bits |= state.open[c] & demanded_[c]; });
    const auto count = [&](RemainingEffects group) {
        return static_cast<std::size_t>(std::popcount(bits & group));
    };
    return std::max({count(layout_.nexts), count(layout_.outputs), count(layout_.timers | layout_.counters)});
}

void LabelSearch::keep(std::size_t used) {
    best_ = path_;
    best_used_ = used;
}

/// Tries all orders of the next steps, deciding the cases of one next step after the other.
void LabelSearch::try_orders(const State& state, std::uint32_t classes, std::size_t used) {
    if (is_done(state)) {
        if (used < best_used_) keep(used);
        return;
    }
    for (std::size_t wanted = 0; wanted < classes_.size(); ++wanted) {
        if (((classes >> wanted) & 1U) == 0 || work_ > most_work_) continue;
        if (used + bound(state) >= best_used_) return;
        const std::size_t before = path_.size();
        State next = state;
        const std::size_t now_used = cover_class(next, classes_[wanted], used);
        if (now_used < best_used_) try_orders(next, classes & ~(1U << wanted), now_used);
        path_.resize(before);
    }
}

/// Repeatedly takes the region that decides most in `cases`. The candidates change only with decisions
/// elsewhere.
std::size_t LabelSearch::cover_class(State& state, const CaseSet& cases, std::size_t used) {
    std::vector<Candidate> list = candidates(state);
    while (used < best_used_ && !is_done(state)) {
        const Candidate* best = most_in(state, cases, list);
        if (best == nullptr) return used;
        const std::size_t left = state.left;
        place(state, best->region, best->kind);
        place_items(state);
        if (state.left != left) list = candidates(state);
        ++used;
    }
    return used;
}

const LabelSearch::Candidate* LabelSearch::most_in(const State& state, const CaseSet& cases,
                                                   const std::vector<Candidate>& list) const {
    const Candidate* best = nullptr;
    std::size_t most = 0;
    for (const Candidate& candidate : list) {
        CaseSet gained = candidate.gains;
        const std::size_t gain = worth(state, gained &= cases, candidate.kind);
        if (gain <= most) continue;
        most = gain;
        best = &candidate;
    }
    return best;
}

/// Whether at most `most` further terms are enough; iterative deepening, so the first solution is minimal.
bool LabelSearch::search(const State& state, std::size_t most, std::size_t depth) {
    if (is_done(state)) {
        keep(depth);
        return true;
    }
    if (most == 0 || work_ > most_work_ || bound(state) > most) return false;
    if (most == 1 && state.left == 0) {
        if (!finish_with_one(state)) return false;
        keep(depth + 1);
        path_.pop_back();
        return true;
    }
    if (failed_before(state, most, false)) return false;
    for (const Candidate& candidate : candidates(state)) {
        const std::size_t before = path_.size();
        State next = state;
        place(next, candidate.region, candidate.kind);
        place_items(next);
        const bool found = search(next, most - 1, depth + 1);
        path_.resize(before);
        if (found) return true;
    }
    failed_before(state, most, true);
    return false;
}

/// All demanded cases are in one region; the smallest such region is most likely uniform.
bool LabelSearch::finish_with_one(const State& state) {
    std::size_t all = error_branch_.cases() - 1;
    std::size_t any = 0;
    RemainingEffects demanded = 0;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        const RemainingEffects still = state.open[c] & demanded_[c];
        if (still == 0) continue;
        demanded |= still;
        all &= c;
        any |= c;
    }
    const std::size_t mask = (std::size_t{1} << inputs()) - 1;
    const Region region{static_cast<std::uint8_t>(all & mask), static_cast<std::uint8_t>(~(all ^ any) & mask),
                        static_cast<std::uint8_t>(all >> inputs())};
    RemainingEffects open = 0;
    set_of(region).for_each([&](std::size_t c) { open |= state.open[c]; });
    const Kinds kinds = kinds_of(open);
    for (unsigned kind = 1; kind <= kinds; kind *= 2) {
        if ((kinds & kind) == 0 || (demanded & ~cleared_by(static_cast<Kinds>(kind))) != 0) continue;
        State last = state;
        place(last, region, static_cast<Kinds>(kind));
        return true;
    }
    return false;
}

bool LabelSearch::failed_before(const State& state, std::size_t most, bool remember) {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (RemainingEffects open : state.open) {
        hash = (hash ^ open) * 0xFF51AFD7ED558CCDU;
        hash ^= hash >> 32;
    }
    auto& slot = failed_[hash % kRemembered];
    if (remember) {
        slot = {hash, most};
        return false;
    }
    return slot.first == hash && slot.second >= most;
}

/// The terms in table order. A term with its own step as the next one is omitted unless it cancels that of an
/// earlier term.
std::vector<PlacedTerm> LabelSearch::result() const {
    std::vector<PlacedTerm> terms = best_;
    std::vector<std::uint8_t> decided(error_branch_.cases());
    for (std::size_t i = 0; i < terms.size(); ++i) {
        PlacedTerm& term = terms[i];
        if (term.order != nullptr && !term.order->is_fast()) continue;
        if (!term.names_next) continue;
        bool needed = term.next != error_branch_.step->number;
        for (std::size_t c = 0; c < decided.size(); ++c) {
            if (!term.region.holds(c, inputs()) || decided[c] != 0) continue;
            decided[c] = 1;
            for (std::size_t j = i + 1; j < terms.size() && !needed; ++j) {
                const PlacedTerm& before = terms[j];
                const bool is_fast = before.order == nullptr || before.order->is_fast();
                needed = is_fast && before.names_next && before.next != error_branch_.step->number &&
                         before.region.holds(c, inputs());
            }
        }
        term.names_next = needed;
    }
    std::reverse(terms.begin(), terms.end());
    return terms;
}

}  // namespace nplc::seqc
