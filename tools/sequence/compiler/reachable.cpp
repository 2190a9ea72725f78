#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>

#include "compiler/checker.h"
#include "language/names.h"
#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

using StepSet = std::bitset<sequencer::kEndOfTable + 1U>;

void add_target(const RawTerm& raw, std::array<StepSet, 64>& targets) {
    const sequencer::Term term = sequencer::decode(raw.bytes);
    if (!term.is_flex) targets[term.condition.step].set(term.fast.next_step);
}

using Targets = std::array<StepSet, 64>;

StepSet reached_from_power_up(const Targets& targets) {
    StepSet reached;
    std::vector<std::size_t> open = {std::size_t{0}};
    while (!open.empty()) {
        const std::size_t from = open.back();
        open.pop_back();
        if (reached.test(from)) continue;
        reached.set(from);
        for (std::size_t to = 0; to < targets.size(); ++to) {
            if (targets[from].test(to)) open.push_back(to);
        }
    }
    return reached;
}

bool has_return(const ast::Sequence& sequence) {
    for (const ast::Step& step : sequence.steps) {
        for (const ast::Choice& choice : step.choices) {
            for (const ast::Branch& branch : choice.branches) {
                if (std::any_of(branch.statements.begin(), branch.statements.end(),
                                [](const auto& statement) {
                                    return statement.kind == ast::Statement::Kind::go_back;
                                }))
                    return true;
            }
        }
    }
    return false;
}

/// Reports each sequence once, and continues as if it returned. True if one was reported.
bool tell_missing_return(const std::vector<MissingReturn>& missing, const StepSet& reached, Targets& targets,
                         Report& report) {
    const auto lost = std::find_if(missing.begin(), missing.end(), [&](const MissingReturn& one) {
        return reached.test(one.from) && !reached.test(one.to);
    });
    if (lost == missing.end()) return false;
    if (!report.has("W005", lost->sequence.span)) {
        report
            .add("W005", lost->sequence.span,
                 fmt::format("'{}' never returns, so '{}', where its CALL goes on, is not reached",
                             lost->sequence.text, lost->back.text),
                 "write RETURN; in the branch in which it is done")
            .notes.push_back({lost->back.span, "the CALL goes on there"});
    }
    targets[lost->from].set(lost->to);
    return true;
}

}  // namespace

std::vector<MissingReturn> missing_returns(const ast::Program& program, const Scope& scope) {
    const auto number_of = [&](std::string_view name) -> std::uint8_t {
        for (std::size_t i = 0; i < scope.steps().size(); ++i) {
            if (same_name(scope.steps()[i]->name.text, name)) return scope.number_of(i);
        }
        return 0;
    };
    std::vector<MissingReturn> missing;
    for (const ast::Sequence& sequence : program.sequences) {
        if (has_return(sequence)) continue;
        for (const ast::Step& step : program.steps) {
            if (!step.origin || !same_name(step.origin->sequence.text, sequence.name.text)) continue;
            missing.push_back({sequence.name, step.origin->back, number_of(step.name.text),
                               number_of(step.origin->back.text)});
        }
    }
    return missing;
}

void warn_unreachable(const Plan& plan, const std::vector<MissingReturn>& missing, Report& report) {
    if (plan.steps.empty() || report.has_errors()) return;
    Targets targets;
    for (const StepPlan& step : plan.steps) {
        for_each_rule(step, [&](const Rule& rule) {
            if (rule.action.next) targets[step.number].set(*rule.action.next);
        });
        for (const RawTerm& raw : step.terms) add_target(raw, targets);
    }
    for (const RawTerm& raw : plan.terms) add_target(raw, targets);
    StepSet reached = reached_from_power_up(targets);
    while (tell_missing_return(missing, reached, targets, report)) reached = reached_from_power_up(targets);
    for (const StepPlan& step : plan.steps) {
        if (reached.test(step.number)) continue;
        report.add("W005", step.span, fmt::format("no step leads to '{}'", step.name),
                   "name it in a NEXT, or delete it");
    }
}

}  // namespace nplc::seqc
