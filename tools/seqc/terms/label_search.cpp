#include "terms/label_search.h"

#include <algorithm>
#include <bit>

namespace nplc::seqc {
namespace {

constexpr std::size_t kWorkForOrders = 150'000;  // cubes looked at
constexpr std::size_t kWorkInAll = 600'000;
constexpr std::size_t kRemembered = 4'096;

bool at_most_one(OpenBits bits) {
    return (bits & (bits - 1)) == 0;
}

}  // namespace

LabelSearch::LabelSearch(const Half& half, const OrderPlan& plan)
    : half_(half), cubes_(Ternary::of(half.inputs)), layout_(half), layers_(half.cases() >> half.inputs) {
    std::vector<std::pair<std::uint8_t, std::uint8_t>> seen;
    for (const Behaviour& behaviour : half.behaviours) {
        const std::pair key{behaviour.next, behaviour.output_byte()};
        const auto found = std::find(seen.begin(), seen.end(), key);
        class_of_.push_back(static_cast<std::uint16_t>(found - seen.begin()));
        if (found == seen.end()) seen.push_back(key);
    }
    classes_ = seen.size();
    for (std::size_t a = 0; a < seen.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) unnamed_help_ = unnamed_help_ || seen[a].second == seen[b].second;
    }
    unnamed_help_ = unnamed_help_ && !at_most_one(layout_.outputs);

    start_.to_send.assign(half.cases(), 0);
    for (std::size_t c = 0; c < half.cases(); ++c) start_.open.push_back(layout_.wanted(half.wanted[c]));
    for (const OrderTerm& term : plan) {
        Item item{&term, {}, {}};
        for (std::size_t c = 0; c < half.cases(); ++c) {
            if (!term.region.holds(c, inputs())) continue;
            item.cases.push_back(static_cast<std::uint16_t>(c));
            item.rank.push_back(start_.to_send[c]++);
        }
        items_.push_back(std::move(item));
    }
    start_.placed.assign(items_.size(), 0);
    start_.left = items_.size();
    masks_.resize(layers_ * cubes_.size());
    kinds_.resize(masks_.size());
}

std::optional<std::vector<PlacedTerm>> LabelSearch::run(std::size_t limit) {
    if (!fits()) return std::nullopt;
    best_used_ = limit + 1;
    most_work_ = kWorkForOrders;
    State state = start_;
    place_items(state);
    if (classes_ <= 16) try_orders(state, (1U << classes_) - 1U, 0);
    most_work_ = kWorkInAll;
    for (std::size_t most = bound(start_); most < best_used_; ++most) {
        failed_.assign(kRemembered, {0, 0});
        if (search(state, most, 0)) break;
        if (work_ > most_work_) break;
    }
    if (best_used_ > limit) return std::nullopt;
    return result();
}

bool LabelSearch::is_done(const State& state) const {
    if (state.left != 0) return false;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        if ((state.open[c] & layout_.demanded(half_.wanted[c])) != 0) return false;
    }
    return true;
}

/// Every next step, output byte and preset that no order can bring along takes a term.
std::size_t LabelSearch::bound(const State& state) const {
    std::array<bool, kCases / 2> carried{};
    for (std::size_t i = 0; i < items_.size() && state.left != 0; ++i) {
        if (state.placed[i] != 0 || !items_[i].term->is_fast()) continue;
        for (std::uint16_t c : items_[i].cases) carried[c] = true;
    }
    OpenBits open = 0;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        if (!carried[c]) open |= state.open[c] & layout_.demanded(half_.wanted[c]);
    }
    const auto count = [&](OpenBits group) { return static_cast<std::size_t>(std::popcount(open & group)); };
    return std::max({count(layout_.nexts), count(layout_.outputs), count(layout_.timers | layout_.counters)});
}

void LabelSearch::keep(std::size_t used) {
    best_ = path_;
    best_used_ = used;
}

/// What each next step, in any order of them, takes when its cases are decided one after the other.
void LabelSearch::try_orders(const State& state, std::uint32_t classes, std::size_t used) {
    if (is_done(state)) {
        if (used < best_used_) keep(used);
        return;
    }
    for (std::size_t wanted = 0; wanted < classes_; ++wanted) {
        if (((classes >> wanted) & 1U) == 0 || work_ > most_work_) continue;
        if (used + bound(state) >= best_used_) return;
        const std::size_t before = path_.size();
        State next = state;
        const std::size_t now_used = cover_class(next, wanted, used);
        if (now_used < best_used_) try_orders(next, classes & ~(1U << wanted), now_used);
        path_.resize(before);
    }
}

std::size_t LabelSearch::cover_class(State& state, std::size_t wanted_class, std::size_t used) {
    while (used < best_used_ && !is_done(state)) {
        const std::vector<Candidate> list = candidates(state);
        const Candidate* best = nullptr;
        std::size_t most = 0;
        for (const Candidate& candidate : list) {
            std::size_t gain = 0;
            for (std::size_t c = 0; c < state.open.size(); ++c) {
                if (class_of_[half_.wanted[c]] != wanted_class) continue;
                if (!candidate.region.holds(c, inputs())) continue;
                gain += static_cast<std::size_t>(std::popcount(state.open[c] & cleared_by(candidate.kind)));
            }
            if (gain > most) {
                most = gain;
                best = &candidate;
            }
        }
        if (best == nullptr) return used;
        place(state, best->region, best->kind, nullptr);
        place_items(state);
        ++used;
    }
    return used;
}

/// Whether at most `most` further terms do; deeper and deeper, so the first answer is the least.
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
        place(next, candidate.region, candidate.kind, nullptr);
        place_items(next);
        const bool found = search(next, most - 1, depth + 1);
        path_.resize(before);
        if (found) return true;
    }
    failed_before(state, most, true);
    return false;
}

/// All that is demanded lies in one region; the smallest one is the likeliest to be of one kind.
bool LabelSearch::finish_with_one(const State& state) {
    std::size_t all = ~std::size_t{0};
    std::size_t any = 0;
    OpenBits demanded = 0;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        const OpenBits still = state.open[c] & layout_.demanded(half_.wanted[c]);
        if (still == 0) continue;
        demanded |= still;
        all &= c;
        any |= c;
    }
    const std::size_t mask = (std::size_t{1} << inputs()) - 1;
    const Region region{static_cast<std::uint8_t>(all & mask), static_cast<std::uint8_t>(~(all ^ any) & mask),
                        static_cast<std::uint8_t>(all >> inputs())};
    OpenBits open = 0;
    for (std::size_t c = 0; c < state.open.size(); ++c) {
        if (region.holds(c, inputs())) open |= state.open[c];
    }
    const Kinds kinds = kinds_of(open);
    for (unsigned k = 0; k < 8; ++k) {
        const auto kind = static_cast<Kinds>(1U << k);
        if ((kinds & kind) == 0 || (demanded & ~cleared_by(kind)) != 0) continue;
        State last = state;
        place(last, region, kind, nullptr);
        return true;
    }
    return false;
}

bool LabelSearch::failed_before(const State& state, std::size_t most, bool remember) {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (OpenBits open : state.open) {
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

/// The terms in table order. A term that names its own step as the next need not, unless it takes that of a
/// term before it back.
std::vector<PlacedTerm> LabelSearch::result() const {
    std::vector<PlacedTerm> terms = best_;
    std::vector<std::uint8_t> decided(half_.cases());
    for (std::size_t i = 0; i < terms.size(); ++i) {
        PlacedTerm& term = terms[i];
        if (term.order != nullptr && !term.order->is_fast()) continue;
        if (!term.names_next) continue;
        bool needed = term.next != half_.step->number;
        for (std::size_t c = 0; c < decided.size(); ++c) {
            if (!term.region.holds(c, inputs()) || decided[c] != 0) continue;
            decided[c] = 1;
            for (std::size_t j = i + 1; j < terms.size() && !needed; ++j) {
                const PlacedTerm& before = terms[j];
                const bool is_fast = before.order == nullptr || before.order->is_fast();
                needed = is_fast && before.names_next && before.next != half_.step->number &&
                         before.region.holds(c, inputs());
            }
        }
        term.names_next = needed;
    }
    std::reverse(terms.begin(), terms.end());
    return terms;
}

}  // namespace nplc::seqc
