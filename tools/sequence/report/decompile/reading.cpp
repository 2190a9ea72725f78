#include "report/decompile/reading.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

constexpr int kNobody = -1;
constexpr int kUnwritten = -1;
constexpr int kLeft = -2;

/// In each case the last true group decides; false if an earlier one would also have an effect there.
bool take_cases(const std::vector<Group>& groups, std::size_t index, std::array<int, kCases>& decisive) {
    const Group& group = groups[index];
    if (!group.sound) return false;
    for (std::size_t c = 0; c < kCases; ++c) {
        if (!group.when.test(c)) continue;
        if (decisive[c] != kNobody) {
            const Group& before = groups[static_cast<std::size_t>(decisive[c])];
            const bool undone = group.writes_outputs && before.writes_outputs && !before.cannot_be_undone() &&
                                (group.action.next || !before.action.next);
            if (!undone) return false;
        }
        decisive[c] = static_cast<int>(index);
    }
    return true;
}

}  // namespace

std::size_t compatible_groups(const std::vector<Group>& groups) {
    std::array<int, kCases> decisive;
    decisive.fill(kNobody);
    std::size_t count = 0;
    while (count < groups.size() && take_cases(groups, count, decisive)) ++count;
    return count;
}

bool Reading::decide() {
    decisive_.fill(kNobody);
    for (std::size_t i = 0; i < count_; ++i) {
        if (!take_cases(groups_, i, decisive_)) return false;
    }
    return true;
}

std::optional<StepPlan> Reading::run(Staying staying, bool on_error) {
    rules_.clear();
    shows_outputs_ = false;
    resting_.fill(kUnwritten);
    if (!decide()) return std::nullopt;
    for (std::size_t c = 0; c < kCases; ++c) {
        const bool error = ((c >> kErrorBit) & 1U) != 0;
        if (on_error && error) {
            if (decisive_[c] == kNobody) return std::nullopt;
            const Group& group = groups_[static_cast<std::size_t>(decisive_[c])];
            if (!group.action.same_effect(*around_.fault)) return std::nullopt;
            if (group.outputs != around_.outputs[*group.action.next]) return std::nullopt;
            resting_[c] = kLeft;
        } else if (decisive_[c] != kNobody && !add_case(c, staying)) {
            return std::nullopt;
        }
    }
    StepPlan plan;
    plan.number = step_;
    plan.outputs = own_outputs();
    plan.own_error = !on_error;
    plan.rules = rules_;
    if (!add_conditional(plan)) return std::nullopt;
    return plan;
}

bool Reading::add_case(std::size_t number, Staying staying) {
    const Group& group = groups_[static_cast<std::size_t>(decisive_[number])];
    Action action = group.action;
    if (group.leaves(step_)) {
        if (group.outputs != around_.outputs[*action.next]) return false;
        resting_[number] = kLeft;
        return add_rule(action, number);
    }
    if (group.writes_outputs) resting_[number] = group.outputs;
    if (action.is_empty()) {
        shows_outputs_ = true;
        return true;
    }
    const bool stays = action.next.has_value();
    action.next.reset();
    const bool alone = action.is_empty();
    if (stays && alone && staying != Staying::is_said) return true;
    if (stays && staying != Staying::undoes) action.next = step_;
    return add_rule(action, number);
}

/// If ON ERROR sends orders, they are in ENTRY of the fault step, so every transition into it must have them.
bool Reading::add_rule(const Action& action, std::size_t number) {
    for (Rule& rule : rules_) {
        if (!rule.action.same_effect(action)) continue;
        rule.when.set(number);
        return true;
    }
    const bool into_fault = around_.fault && action.next == around_.fault->next;
    if (into_fault && !ends_with(action, *around_.fault)) return false;
    Rule rule;
    rule.action = action;
    rule.when.set(number);
    rules_.push_back(std::move(rule));
    return true;
}

/// Outputs that change while the step is active. They are then written in every scan.
bool Reading::add_conditional(StepPlan& plan) const {
    const std::uint8_t own = own_outputs();
    const bool always_written = step_ == 0 && own != 0;
    bool differ = false;
    bool unwritten = false;
    for (int outputs : resting_) {
        differ = differ || (outputs >= 0 && outputs != own);
        unwritten = unwritten || outputs == kUnwritten;
        if (outputs >= 0 && (outputs & own) != own) return false;
    }
    if (shows_outputs_ && !differ && !always_written) return false;  // a term without effect
    if ((differ || always_written) && unwritten) return false;
    if (always_written) plan.conditional.push_back({own, always()});
    for (std::uint8_t bit = 1; bit < 16; bit = static_cast<std::uint8_t>(bit << 1)) {
        if ((own & bit) != 0) continue;
        ConditionalOutput output{bit, {}};
        for (std::size_t c = 0; c < kCases; ++c)
            output.when[c] = resting_[c] >= 0 && (resting_[c] & bit) != 0;
        if (output.when.none()) continue;
        const auto alike = std::find_if(plan.conditional.begin(), plan.conditional.end(),
                                        [&](const ConditionalOutput& o) { return o.when == output.when; });
        if (alike != plan.conditional.end() && alike->outputs != own) {
            alike->outputs |= bit;
        } else {
            plan.conditional.push_back(output);
        }
    }
    return true;
}

}  // namespace nplc::seqc
