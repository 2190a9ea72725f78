#include <fmt/format.h>

#include <array>
#include <bitset>

#include "semantics/checker.h"
#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

using StepSet = std::bitset<sequencer::kEndOfTable + 1U>;

void add_target(const RawTerm& raw, std::array<StepSet, 64>& targets) {
    if (sequencer::is_flex(raw.bytes)) return;
    targets[sequencer::step_of(raw.bytes)].set(raw.bytes[3] & 0x3F);
}

}  // namespace

void warn_unreachable(const Plan& plan, Report& report) {
    if (plan.steps.empty() || report.has_errors()) return;
    std::array<StepSet, 64> targets;
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) {
            if (rule.action.next) targets[step.number].set(*rule.action.next);
        }
        for (const RawTerm& raw : step.terms) add_target(raw, targets);
    }
    for (const RawTerm& raw : plan.terms) add_target(raw, targets);
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
    for (const StepPlan& step : plan.steps) {
        if (reached.test(step.number)) continue;
        report.add("W005", step.span, fmt::format("no step leads to '{}'", step.name),
                   "name it in a NEXT, or take it out");
    }
}

}  // namespace nplc::seqc
