#include "compiler/written.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "language/names.h"

namespace nplc::seqc {
namespace {

Written::Branch branch_of(const Truth& when, const Truth& own, const Action& action, Span condition) {
    return {.when = when,
            .own = own,
            .condition = condition,
            .statements = action.statements,
            .next = action.next,
            .by_helper = {}};
}

void add_branches(const StepPlan& step, const Rule& rule, std::vector<Written::Branch>& branches) {
    if (rule.is_made) return;
    if (rule.parts.empty()) {
        branches.push_back(
            branch_of(rule.when, rule.when, rule.action, step.is_helper ? Span{} : rule.condition));
        return;
    }
    for (const RulePart& part : rule.parts) {
        branches.push_back(branch_of(part.when, part.own, part.action, part.condition));
        if (part.action.next != rule.action.next) branches.back().by_helper = rule.action.next;
    }
}

/// ON conditions come before the step's own branches.
void sort_as_judged(std::vector<Written::Branch>& branches, const std::vector<Written::Everywhere>& first) {
    const auto place = [&](const Written::Branch& branch) {
        const bool is_own = std::none_of(first.begin(), first.end(),
                                         [&](const auto& on) { return on.condition == branch.condition; });
        return std::pair(is_own, branch.condition.offset);
    };
    std::stable_sort(branches.begin(), branches.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

Written::Step step_of(const StepPlan& plan) {
    Written::Step step{.number = plan.number,
                       .is_helper = plan.is_helper,
                       .branches = {},
                       .entry = plan.entry,
                       .outputs = {},
                       .blinking = plan.memory.blinking};
    for (const Rule& rule : plan.rules) add_branches(plan, rule, step.branches);
    for (const RulePart& part : plan.idle) {
        step.branches.push_back(branch_of(part.when, part.own, part.action, part.condition));
        step.branches.back().is_idle = true;
    }
    for (const ConditionalOutput& output : plan.conditional) {
        if (output.condition.length != 0)
            step.outputs.push_back({output.outputs, output.when, output.condition});
    }
    return step;
}

const ast::Step* find_step(const ast::Program& program, std::string_view name) {
    const auto found = std::find_if(program.steps.begin(), program.steps.end(),
                                    [&](const ast::Step& s) { return same_name(s.name.text, name); });
    return found == program.steps.end() ? nullptr : &*found;
}

std::vector<Written::Argument> arguments_of(const ast::Step* found) {
    std::vector<Written::Argument> arguments;
    if (found == nullptr || !found->origin) return arguments;
    for (const auto& [parameter, text] : found->origin->arguments)
        arguments.push_back({std::string(parameter), std::string(text)});
    return arguments;
}

Written::Everywhere everywhere_of(const ast::OnCondition& on) {
    const Span condition = on.condition.span;
    const std::vector<ast::Name>& last = on.except.empty() ? on.only : on.except;
    if (last.empty()) return {condition, {}};
    const std::uint32_t begin = condition.offset + condition.length;
    return {condition, {begin, last.back().span.offset + last.back().span.length - begin}};
}

}  // namespace

Written written_of(const ast::Program& program, const Plan& plan, const std::vector<Send>& initial_values) {
    Written written;
    std::transform(program.on_conditions.begin(), program.on_conditions.end(),
                   std::back_inserter(written.everywhere), everywhere_of);
    for (const StepPlan& step : plan.steps) {
        written.steps.push_back(step_of(step));
        const ast::Step* found = find_step(program, step.name);
        written.steps.back().arguments = arguments_of(found);
        if (found != nullptr && !found->blinking.empty())
            written.steps.back().blink_time = found->blinking.front().time.span;
        sort_as_judged(written.steps.back().branches, written.everywhere);
        if (step.number != 0) continue;
        std::vector<Span>& entry = written.steps.back().entry;
        for (const Send& value : initial_values) entry.push_back(value.span);
    }
    return written;
}

}  // namespace nplc::seqc
