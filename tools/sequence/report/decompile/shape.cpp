#include "report/decompile/shape.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "lowering/lower.h"
#include "report/decompile/reading.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMostGroups = 64;  // beyond it a chain of branches is unreadable
constexpr std::size_t kMostLeft = 16;    // groups removed from its end in search of a shape: 0, 1, 2, 4 ..
constexpr std::size_t kMostSwaps = 40;
constexpr std::array kStayings = {Staying::undoes, Staying::mixed, Staying::is_said};

const BitNames& plain_names() {
    static const BitNames names = {
        {"IN0", "IN1", "IN2", "IN3", "IN4", "IN5", "INPOS", "ERROR", "TIMER.Q", "COUNTER.Q"}};
    return names;
}

int cost_of(const std::vector<Rule>& rules) {
    int cost = 0;
    for (const Link& link : chain_of(rules, plain_names())) cost += link.condition.cost;
    return cost;
}

/// Finds the order of branches that gives the wanted terms and is easiest to read.
class OrderSearch {
  public:
    OrderSearch(const Part& part, std::size_t count, const Surroundings& around)
        : part_(part), count_(count), around_(around) {}

    std::optional<StepPlan> run(StepPlan plan, const std::vector<Group>& groups) {
        sort_by_place(plan.rules, groups);
        StepPlan backwards = plan;
        std::reverse(backwards.rules.begin(), backwards.rules.end());
        consider(plan);
        if (plan.rules.size() > 1) consider(backwards);
        if (best_) improve();
        return best_;
    }

  private:
    static void sort_by_place(std::vector<Rule>& rules, const std::vector<Group>& groups) {
        const auto place = [&](const Rule& rule) {
            return std::find_if(groups.begin(), groups.end(),
                                [&](const Group& g) { return (g.when & rule.when).any() && says(g, rule); });
        };
        std::stable_sort(rules.begin(), rules.end(),
                         [&](const Rule& a, const Rule& b) { return place(a) < place(b); });
    }

    /// The rule's NEXT to its own step may have been omitted.
    static bool says(const Group& group, const Rule& rule) {
        Action action = group.action;
        if (!rule.action.next) action.next.reset();
        return action.same_effect(rule.action);
    }

    void consider(const StepPlan& plan) {
        const int cost = cost_of(plan.rules);
        if ((best_ && cost >= best_cost_) || !makes(plan, part_, count_, around_)) return;
        best_ = plan;
        best_cost_ = cost;
    }

    void improve() {
        std::size_t tries = 0;
        bool better = true;
        while (better) {
            better = false;
            for (std::size_t i = 0; i + 1 < best_->rules.size() && tries < kMostSwaps; ++i, ++tries) {
                StepPlan swapped = *best_;
                std::swap(swapped.rules[i], swapped.rules[i + 1]);
                const int before = best_cost_;
                consider(swapped);
                better = better || best_cost_ < before;
            }
        }
    }

    const Part& part_;
    std::size_t count_;
    const Surroundings& around_;
    std::optional<StepPlan> best_;
    int best_cost_ = std::numeric_limits<int>::max();
};

class ShapeSearch {
  public:
    ShapeSearch(const Part& part, const std::vector<Group>& groups, const Surroundings& around)
        : part_(part), groups_(groups), around_(around) {}

    std::optional<Shape> run() {
        const std::size_t compatible = std::min(compatible_groups(groups_), kMostGroups);
        for (std::size_t left = 0; left < compatible && left <= kMostLeft; left = left == 0 ? 1 : 2 * left) {
            if (auto shape = shape_of(compatible - left)) return shape;
        }
        return compatible > 1 ? shape_of(1) : std::nullopt;
    }

  private:
    std::optional<Shape> shape_of(std::size_t count) {
        std::optional<StepPlan> plan = plan_of(count);
        return plan ? std::optional(Shape{std::move(*plan), terms_in(count)}) : std::nullopt;
    }

    std::size_t terms_in(std::size_t count) const {
        return count == groups_.size() ? part_.terms.size() : groups_[count].first;
    }

    /// The remaining TERMs are for other cases; or they are few, and no branch stays active together with
    /// them.
    bool can_stand_before_the_rest(const StepPlan& plan, std::size_t count) const {
        Truth left;
        Truth taken;
        Truth staying;
        for (std::size_t i = count; i < groups_.size(); ++i) left |= groups_[i].when;
        for (std::size_t i = 0; i < count; ++i) taken |= groups_[i].when;
        for (const Rule& rule : plan.rules) {
            if (!rule.action.next || *rule.action.next == part_.number) staying |= rule.when;
        }
        if (!plan.conditional.empty()) return false;  // written in every scan, so together with all of them
        const bool are_few = 3 * terms_in(count) >= 2 * part_.terms.size();
        return (left & taken).none() || (are_few && (left & staying).none());
    }

    std::optional<StepPlan> plan_of(std::size_t count) {
        const bool may_use_fault = around_.fault && around_.fault->next != part_.number;
        Reading reading(part_.number, groups_, count, around_);
        for (const bool on_error : {true, false}) {
            if (on_error && !may_use_fault) continue;
            std::optional<StepPlan> last;
            for (const Staying staying : kStayings) {
                std::optional<StepPlan> plan = reading.run(staying, on_error);
                if (!plan || (last && same(*plan, *last))) continue;
                if (count < groups_.size() && !can_stand_before_the_rest(*plan, count)) continue;
                last = plan;
                auto found = OrderSearch(part_, terms_in(count), around_).run(std::move(*plan), groups_);
                if (found) return found;
            }
        }
        return std::nullopt;
    }

    static bool same(const StepPlan& a, const StepPlan& b) {
        return std::equal(a.rules.begin(), a.rules.end(), b.rules.begin(), b.rules.end(),
                          [](const Rule& x, const Rule& y) { return x.action.same_effect(y.action); });
    }

    const Part& part_;
    const std::vector<Group>& groups_;
    const Surroundings& around_;
};

/// The leading sends that write registers, no register twice.
std::size_t leading_values(const std::vector<Send>& sends) {
    std::size_t count = 0;
    const auto seen = [&](const registers::Register* reg) {
        return std::any_of(sends.begin(), sends.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const Send& s) { return s.reg == reg; });
    };
    while (count < sends.size() && sends[count].reg != nullptr && !seen(sends[count].reg)) ++count;
    return count;
}

}  // namespace

std::vector<Link> chain_of(const std::vector<Rule>& rules, const BitNames& names) {
    std::vector<Link> chain;
    Truth taken;
    for (const Rule& rule : rules) {
        taken |= rule.when;
        chain.push_back({formula_of(rule.when, taken, names), &rule.action});
    }
    return chain;
}

bool ends_with(const Action& action, const Action& tail) {
    if (tail.sends.size() > action.sends.size()) return false;
    const bool sends = std::equal(tail.sends.rbegin(), tail.sends.rend(), action.sends.rbegin(),
                                  [](const Send& a, const Send& b) { return a.same_effect(b); });
    return sends && (!tail.timer || tail.timer == action.timer) &&
           (!tail.counter || tail.counter == action.counter) &&
           (!tail.clears_counter || action.clears_counter) && (!tail.counts_down || action.counts_down);
}

const Action* error_exit(const Part& part, const std::vector<Group>& groups, const Surroundings& around) {
    const Group* exit = nullptr;
    Truth cases;
    for (const Group& group : groups) {
        if ((group.when & truth_of_bit(kErrorBit)).none()) continue;
        if (!group.sound || (exit != nullptr && !exit->action.same_effect(group.action))) return nullptr;
        exit = &group;
        cases |= group.when;
    }
    const bool whole = exit != nullptr && cases == truth_of_bit(kErrorBit);
    const bool clear =
        whole && exit->leaves(part.number) && exit->outputs == around.outputs[*exit->action.next];
    return clear ? &exit->action : nullptr;
}

bool makes(const StepPlan& plan, const Part& part, std::size_t count, const Surroundings& around) {
    StepPlan whole = plan;
    if (!plan.own_error && around.fault) whole.rules.push_back({truth_of_bit(kErrorBit), *around.fault});
    Report report;
    const std::vector<LoweredTerm> made = lower(whole, around.outputs, report);
    return !report.has_errors() && made.size() == count &&
           std::equal(made.begin(), made.end(), part.terms.begin(),
                      [](const LoweredTerm& a, const sequencer::TermBytes& b) { return a.bytes == b; });
}

std::optional<Shape> find_shape(const Part& part, const std::vector<Group>& groups,
                                const Surroundings& around) {
    if (groups.size() > kMostGroups * 2) return std::nullopt;
    return ShapeSearch(part, groups, around).run();
}

std::optional<PowerUp> find_power_up(const Part& part, const std::vector<Group>& groups,
                                     const Surroundings& around) {
    if (groups.size() != (around.fault ? 2 : 1) || around.outputs[0] != 0) return std::nullopt;
    const Group* start = nullptr;
    const Group* error = nullptr;
    for (const Group& group : groups) {
        if (!group.sound || !group.leaves(0) || group.outputs != around.outputs[*group.action.next])
            return std::nullopt;
        if (group.when == ~truth_of_bit(kErrorBit)) start = &group;
        if (group.when == truth_of_bit(kErrorBit)) error = &group;
    }
    if (start == nullptr || (error == nullptr) == around.fault.has_value()) return std::nullopt;
    PowerUp result{start->action, leading_values(start->action.sends), start->action};
    StepPlan plan;
    plan.own_error = true;
    plan.rules.push_back({start->when, result.action});
    if (error != nullptr) {
        Action fault = *around.fault;
        const std::size_t sent = error->action.sends.size();
        if (sent < fault.sends.size() || sent - fault.sends.size() > result.values) return std::nullopt;
        result.values = sent - fault.sends.size();
        fault.sends.insert(fault.sends.begin(), result.action.sends.begin(),
                           result.action.sends.begin() + static_cast<std::ptrdiff_t>(result.values));
        plan.rules.push_back({error->when, fault});
    }
    std::vector<Send>& commands = result.commands.sends;
    commands.erase(commands.begin(), commands.begin() + static_cast<std::ptrdiff_t>(result.values));
    if (error != nullptr && result.action.next == around.fault->next &&
        !ends_with(result.commands, *around.fault))
        return std::nullopt;
    return makes(plan, part, part.terms.size(), around) ? std::optional(result) : std::nullopt;
}

}  // namespace nplc::seqc
