#include "lowering/order_plan.h"

#include <algorithm>

#include "lowering/sharing.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMostBranches = 32;
constexpr std::size_t kMostToMerge = 12;
constexpr std::size_t kMostInEveryWay = 4;  // branches up to which all ways to share are tried
constexpr std::size_t kImpossible = SIZE_MAX / 4;

class Planner {
  public:
    explicit Planner(const ReducedStep& error_branch)
        : error_branch_(error_branch), sharing_(error_branch), branches_(sharing_.branches()) {}

    std::vector<OrderPlan> run() {
        if (branches_.empty()) return {OrderPlan{}};
        if (branches_.size() > kMostBranches) return {};
        find_common_orders();
        std::vector<Branches> groups;
        if (branches_.size() <= kMostInEveryWay) {
            every_way(0, groups);
        } else {
            for (std::size_t b = 0; b < branches_.size(); ++b) groups.push_back(Branches{1} << b);
            add_way(groups);
            if (branches_.size() <= kMostToMerge) merge_step_by_step(std::move(groups));
        }
        const auto shorter = [](const Way& a, const Way& b) { return a.terms < b.terms; };
        std::stable_sort(ways_.begin(), ways_.end(), shorter);
        std::vector<OrderPlan> plans;
        for (const Way& way : ways_) {
            if (way.shares && way.terms >= apart_) continue;
            plans.push_back(plan_of(way, false));
            if (needs_choice(plans.back())) plans.push_back(plan_of(way, true));
        }
        return plans;
    }

  private:
    /// Tries every grouping of the branches from `next` on.
    void every_way(std::size_t next, std::vector<Branches>& groups) {
        if (next == branches_.size()) {
            add_way(groups);
            return;
        }
        const Branches one = Branches{1} << next;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            if ((groups[i] & common_[next]) == 0) continue;
            groups[i] |= one;
            every_way(next + 1, groups);
            groups[i] &= ~one;
        }
        groups.push_back(one);
        every_way(next + 1, groups);
        groups.pop_back();
    }

    /// Greedy: repeatedly merges the two groups with the largest saving.
    void merge_step_by_step(std::vector<Branches> groups) {
        while (groups.size() > 1) {
            std::size_t best_saving = 0;
            std::size_t best_a = 0;
            std::size_t best_b = 0;
            for (std::size_t a = 0; a < groups.size(); ++a) {
                for (std::size_t b = a + 1; b < groups.size(); ++b) {
                    if (!have_common_order(groups[a], groups[b])) continue;
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

    bool have_common_order(Branches a, Branches b) const {
        for (std::size_t i = 0; i < branches_.size(); ++i) {
            if (((a >> i) & 1U) != 0 && (common_[i] & b) != 0) return true;
        }
        return false;
    }

    /// Finds the branches with a common order.
    void find_common_orders() {
        common_.assign(branches_.size(), 0);
        for (std::size_t a = 0; a < branches_.size(); ++a) {
            for (std::size_t b = 0; b < branches_.size(); ++b) {
                const auto in_b = [&](const Send& send) {
                    return std::any_of(branches_[b].sends->begin(), branches_[b].sends->end(),
                                       [&](const Send& other) { return other.same_effect(send); });
                };
                const bool common = std::any_of(branches_[a].sends->begin(), branches_[a].sends->end(), in_b);
                if (a != b && common) common_[a] |= Branches{1} << b;
            }
        }
    }

    std::size_t terms_of(Branches group) {
        const auto way = sharing_.align(group, false);
        return way ? way->terms : kImpossible;
    }

    void add_way(const std::vector<Branches>& groups) {
        for (bool own_ends : {false, true}) {
            Way way;
            way.shares = groups.size() != branches_.size();
            bool possible = true;
            for (Branches group : groups) {
                const auto part = sharing_.align(group, own_ends);
                possible = possible && part.has_value();
                if (!possible) break;
                way.columns.insert(way.columns.end(), part->columns.begin(), part->columns.end());
                way.terms += part->terms;
            }
            if (!possible) continue;
            if (!way.shares) apart_ = way.terms;
            ways_.push_back(std::move(way));
            if (!ways_.back().shares) return;
        }
    }

    /// A case that needs both presets and has one FastMAC order, which can carry either.
    bool needs_choice(const OrderPlan& plan) const {
        for (std::size_t c = 0; c < error_branch_.cases(); ++c) {
            const Behaviour& wanted = error_branch_.at(c);
            if (wanted.timer() == 0 || wanted.counter() == 0) continue;
            const auto carriers = std::count_if(plan.begin(), plan.end(), [&](const OrderTerm& term) {
                return term.is_fast() && term.region.holds(c, error_branch_.inputs);
            });
            if (carriers == 1) return true;
        }
        return false;
    }

    OrderPlan plan_of(const Way& way, bool counter_first) {
        OrderPlan plan;
        for (const Column& column : way.columns) {
            for (const Region& region : *sharing_.regions(column.branches))
                plan.push_back({region, column.send, {}});
        }
        std::vector<std::uint8_t> carried(error_branch_.cases());  // bit 0 the timer, bit 1 the counter
        for (OrderTerm& term : plan) {
            if (!term.is_fast()) continue;
            for (int attempt = 0; attempt < 2 && term.preset == Preset::none; ++attempt) {
                const bool timer = (attempt == 0) != counter_first;
                if (ride(term, timer, carried)) term.preset = timer ? Preset::timer : Preset::counter;
            }
        }
        return plan;
    }

    /// Whether all cases of the term need the same preset and some have not got it from an earlier term.
    bool ride(const OrderTerm& term, bool timer, std::vector<std::uint8_t>& carried) const {
        const std::uint8_t bit = timer ? 1 : 2;
        std::uint16_t value = 0;
        bool is_new = false;
        for (std::size_t c = 0; c < error_branch_.cases(); ++c) {
            if (!term.region.holds(c, error_branch_.inputs)) continue;
            const std::uint16_t wanted = timer ? error_branch_.at(c).timer() : error_branch_.at(c).counter();
            if (wanted == 0 || (value != 0 && wanted != value)) return false;
            value = wanted;
            is_new = is_new || (carried[c] & bit) == 0;
        }
        if (!is_new) return false;
        for (std::size_t c = 0; c < error_branch_.cases(); ++c) {
            if (term.region.holds(c, error_branch_.inputs)) carried[c] |= bit;
        }
        return true;
    }

    const ReducedStep& error_branch_;
    Sharing sharing_;
    const std::vector<Branch>& branches_;
    std::vector<Branches> common_;  // by branch: the others with a common order
    std::vector<Way> ways_;
    std::size_t apart_ = SIZE_MAX;  // number of terms without sharing; sharing must save some
};

}  // namespace

std::vector<OrderPlan> order_plans(const ReducedStep& error_branch) {
    return Planner(error_branch).run();
}

}  // namespace nplc::seqc
