#include "terms/order_plan.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

#include "terms/cover.h"

namespace nplc::seqc {
namespace {

using Branches = std::uint32_t;  // a set of branches that send
constexpr std::size_t kMostBranches = 12;
constexpr std::size_t kMostInEveryWay = 4;  // branches for which all ways to share are tried
constexpr std::size_t kMostWork = 65'536;
constexpr std::size_t kImpossible = SIZE_MAX / 4;

struct Branch {
    std::uint16_t behaviour = 0;
    const std::vector<Send>* sends = nullptr;
    std::size_t last_fast = 0;  // its position + 1; 0: none
};

struct Column {
    Branches branches = 0;
    const Send* send = nullptr;
};

struct Way {
    std::vector<Column> columns;
    std::size_t terms = 0;
};

class Planner {
  public:
    explicit Planner(const Half& half) : half_(half) {
        for (std::size_t b = 0; b < half.behaviours.size(); ++b) {
            if (half.behaviours[b].sends() == 0) continue;
            Branch branch{static_cast<std::uint16_t>(b), &half.behaviours[b].action->sends, 0};
            for (std::size_t i = 0; i < branch.sends->size(); ++i) {
                if ((*branch.sends)[i].reg == nullptr) branch.last_fast = i + 1;
            }
            branches_.push_back(branch);
        }
    }

    std::vector<OrderPlan> run() {
        if (branches_.empty()) return {OrderPlan{}};
        if (branches_.size() > kMostBranches) return {};
        std::vector<Branches> groups;
        if (branches_.size() <= kMostInEveryWay) {
            every_way(0, groups);
        } else {
            for (std::size_t b = 0; b < branches_.size(); ++b) groups.push_back(Branches{1} << b);
            merge_step_by_step(std::move(groups));
        }
        const auto shorter = [](const Way& a, const Way& b) { return a.terms < b.terms; };
        std::stable_sort(ways_.begin(), ways_.end(), shorter);
        std::vector<OrderPlan> plans;
        for (const Way& way : ways_) {
            plans.push_back(plan_of(way, false));
            if (needs_choice(plans.back())) plans.push_back(plan_of(way, true));
        }
        return plans;
    }

  private:
    using Regions = std::optional<std::vector<Region>>;

    bool contains(Branches set, std::size_t reduced) const {
        for (std::size_t b = 0; b < branches_.size(); ++b) {
            if (((set >> b) & 1U) != 0 && half_.wanted[reduced] == branches_[b].behaviour) return true;
        }
        return false;
    }

    /// Disjoint regions that hold the cases of these branches; none where the table cannot tell them apart.
    const Regions& regions(Branches set) {
        const auto [found, is_new] = regions_.try_emplace(set);
        if (is_new) found->second = make_regions(set);
        return found->second;
    }

    Regions make_regions(Branches set) const {
        const std::size_t layers = half_.cases() >> half_.inputs;
        std::vector<Points> by_zeros(layers);
        const std::size_t mask = (std::size_t{1} << half_.inputs) - 1;
        for (std::size_t point = 0; point < kPoints; ++point) {
            std::size_t first = layers;
            for (std::size_t zeros = 0; zeros < layers && first == layers; ++zeros) {
                if (contains(set, (point & mask) | zeros << half_.inputs)) first = zeros;
            }
            if (first == layers) continue;
            for (std::size_t zeros = first; zeros < layers; ++zeros) {
                const bool in = contains(set, (point & mask) | zeros << half_.inputs);
                if (in != ((zeros & first) == first)) return std::nullopt;
            }
            by_zeros[first].set(point);
        }
        std::vector<Region> result;
        for (std::size_t zeros = 0; zeros < layers; ++zeros) {
            for (Cube cube : disjoint_cover(by_zeros[zeros]))
                result.push_back({cube.value, cube.care, static_cast<std::uint8_t>(zeros)});
        }
        return result;
    }

    /// Every way to put the branches from `next` on into groups that share.
    void every_way(std::size_t next, std::vector<Branches>& groups) {
        if (next == branches_.size()) {
            add_way(groups);
            return;
        }
        const Branches one = Branches{1} << next;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            groups[i] |= one;
            every_way(next + 1, groups);
            groups[i] &= ~one;
        }
        groups.push_back(one);
        every_way(next + 1, groups);
        groups.pop_back();
    }

    /// Joins the two groups for which that saves most, again and again.
    void merge_step_by_step(std::vector<Branches> groups) {
        add_way(groups);
        while (groups.size() > 1) {
            std::size_t best_saving = 0;
            std::size_t best_a = 0;
            std::size_t best_b = 0;
            for (std::size_t a = 0; a < groups.size(); ++a) {
                for (std::size_t b = a + 1; b < groups.size(); ++b) {
                    const std::size_t apart = terms_of(groups[a]) + terms_of(groups[b]);
                    const std::size_t together = terms_of(groups[a] | groups[b]);
                    if (together >= apart || apart - together <= best_saving) continue;
                    best_saving = apart - together;
                    best_a = a;
                    best_b = b;
                }
            }
            if (best_saving == 0) return;
            groups[best_a] |= groups[best_b];
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(best_b));
            add_way(groups);
        }
    }

    std::size_t terms_of(Branches group) {
        const auto way = align(group, false);
        return way ? way->terms : kImpossible;
    }

    void add_way(const std::vector<Branches>& groups) {
        for (bool own_ends : {false, true}) {
            Way way;
            bool possible = true;
            for (Branches group : groups) {
                const auto part = align(group, own_ends);
                possible = possible && part.has_value();
                if (!possible) break;
                way.columns.insert(way.columns.end(), part->columns.begin(), part->columns.end());
                way.terms += part->terms;
            }
            if (possible) ways_.push_back(std::move(way));
            if (groups.size() == branches_.size()) return;
        }
    }

    /// The columns in which the branches of `group` send their orders with the fewest terms. With
    /// `own_ends` the last FastMAC order of a branch is not shared with one that ends otherwise, since it
    /// carries the next step.
    const std::optional<Way>& align(Branches group, bool own_ends) {
        const auto [found, is_new] = aligned_.try_emplace({group, own_ends});
        if (is_new) found->second = make_way(group, own_ends);
        return found->second;
    }

    std::optional<Way> make_way(Branches group, bool own_ends);
    bool ends_clash(Branches set, const std::vector<std::size_t>& positions) const;

    /// A case that wants both presets and has one FastMAC order: either may ride.
    bool needs_choice(const OrderPlan& plan) const {
        for (std::size_t c = 0; c < half_.cases(); ++c) {
            const Behaviour& wanted = half_.at(c);
            if (wanted.timer() == 0 || wanted.counter() == 0) continue;
            const auto carriers = std::count_if(plan.begin(), plan.end(), [&](const OrderTerm& term) {
                return term.is_fast() && term.region.holds(c, half_.inputs);
            });
            if (carriers == 1) return true;
        }
        return false;
    }

    OrderPlan plan_of(const Way& way, bool counter_first) {
        OrderPlan plan;
        for (const Column& column : way.columns) {
            for (const Region& region : *regions(column.branches)) plan.push_back({region, column.send, {}});
        }
        std::vector<std::uint8_t> carried(half_.cases());  // bit 0 the timer, bit 1 the counter
        for (OrderTerm& term : plan) {
            if (!term.is_fast()) continue;
            for (int attempt = 0; attempt < 2 && term.preset == Preset::none; ++attempt) {
                const bool timer = (attempt == 0) != counter_first;
                if (ride(term, timer, carried)) term.preset = timer ? Preset::timer : Preset::counter;
            }
        }
        return plan;
    }

    /// Whether all cases of the term want the same preset and some have it from no term before.
    bool ride(const OrderTerm& term, bool timer, std::vector<std::uint8_t>& carried) const {
        const std::uint8_t bit = timer ? 1 : 2;
        std::uint16_t value = 0;
        bool is_new = false;
        for (std::size_t c = 0; c < half_.cases(); ++c) {
            if (!term.region.holds(c, half_.inputs)) continue;
            const std::uint16_t wanted = timer ? half_.at(c).timer() : half_.at(c).counter();
            if (wanted == 0 || (value != 0 && wanted != value)) return false;
            value = wanted;
            is_new = is_new || (carried[c] & bit) == 0;
        }
        if (!is_new) return false;
        for (std::size_t c = 0; c < half_.cases(); ++c) {
            if (term.region.holds(c, half_.inputs)) carried[c] |= bit;
        }
        return true;
    }

    const Half& half_;
    std::vector<Branch> branches_;
    std::map<Branches, Regions> regions_;
    std::map<std::pair<Branches, bool>, std::optional<Way>> aligned_;
    std::vector<Way> ways_;
};

/// Whether branches of `set` that go on differently have their last FastMAC order here, which carries the
/// next step.
bool Planner::ends_clash(Branches set, const std::vector<std::size_t>& positions) const {
    const Behaviour* first = nullptr;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        if (((set >> b) & 1U) == 0 || positions[b] + 1 != branches_[b].last_fast) continue;
        const Behaviour& behaviour = half_.behaviours[branches_[b].behaviour];
        if (first == nullptr) first = &behaviour;
        if (behaviour.next != first->next || behaviour.output_byte() != first->output_byte()) return true;
    }
    return false;
}

/// Shortest path over "how many orders of each branch are sent".
std::optional<Way> Planner::make_way(Branches group, bool own_ends) {
    std::vector<std::size_t> members;
    std::size_t states = 1;
    for (std::size_t b = 0; b < branches_.size(); ++b) {
        if (((group >> b) & 1U) == 0) continue;
        members.push_back(b);
        states *= branches_[b].sends->size() + 1;
        if (members.size() > 1 && states << members.size() > kMostWork) return std::nullopt;
    }
    struct Best {
        std::size_t cost = SIZE_MAX;  // terms, and less where fewer branches share
        std::size_t from = 0;
        Column column;
    };
    std::vector<Best> best(states);
    best[0].cost = 0;
    std::vector<std::size_t> positions(branches_.size());
    for (std::size_t state = 0; state + 1 < states; ++state) {
        if (best[state].cost == SIZE_MAX) continue;
        std::size_t rest = state;
        for (std::size_t b : members) {
            positions[b] = rest % (branches_[b].sends->size() + 1);
            rest /= branches_[b].sends->size() + 1;
        }
        for (std::uint32_t pick = 1; pick < (1U << members.size()); ++pick) {
            Column column;
            std::size_t to = state;
            std::size_t stride = 1;
            bool possible = true;
            for (std::size_t i = 0; i < members.size() && possible; ++i) {
                const Branch& branch = branches_[members[i]];
                const std::size_t position = positions[members[i]];
                if (((pick >> i) & 1U) != 0) {
                    possible = position < branch.sends->size();
                    const Send* send = possible ? &(*branch.sends)[position] : nullptr;
                    possible = possible && (column.send == nullptr || column.send->same_effect(*send));
                    if (column.send == nullptr) column.send = send;
                    column.branches |= Branches{1} << members[i];
                    to += stride;
                }
                stride *= branch.sends->size() + 1;
            }
            const bool clash = possible && ends_clash(column.branches, positions);
            if (!possible || (clash && own_ends)) continue;
            const Regions& needed = regions(column.branches);
            if (!needed) continue;
            const std::size_t cost = best[state].cost + needed->size() * 10'000 + (clash ? 100 : 0) +
                                     static_cast<std::size_t>(std::popcount(column.branches)) - 1;
            if (cost < best[to].cost) best[to] = {cost, state, column};
        }
    }
    if (best.back().cost == SIZE_MAX) return std::nullopt;
    Way way;
    for (std::size_t state = states - 1; state != 0; state = best[state].from) {
        way.columns.push_back(best[state].column);
        way.terms += regions(best[state].column.branches)->size();
    }
    std::reverse(way.columns.begin(), way.columns.end());
    return way;
}

}  // namespace

std::vector<OrderPlan> order_plans(const Half& half) {
    return Planner(half).run();
}

}  // namespace nplc::seqc
