#pragma once

#include <algorithm>

#include "compiler/model.h"
#include "language/ast.h"

namespace nplc::seqc {

/// The condition of an ON.
inline bool is_guard(const ast::Program& program, Span condition) {
    return std::any_of(program.on_conditions.begin(), program.on_conditions.end(),
                       [&](const ast::OnCondition& on) { return on.condition.span == condition; });
}

/// It holds with ERROR only.
inline bool needs_error(const Truth& when) {
    return (when & ~truth_of_bit(kErrorBit)).none();
}

/// Each branch of the rule with its cases; the rule itself where nothing was joined.
template <class Visit>
void for_each_part(const Rule& rule, const Visit& visit) {
    if (rule.parts.empty()) visit(rule.when, rule.condition);
    for (const RulePart& part : rule.parts) visit(part.when, part.condition);
}

/// Some of what TERMs do is nowhere in a plan's rules.
inline bool has_terms(const Plan& plan) {
    return !plan.terms.empty() || std::any_of(plan.steps.begin(), plan.steps.end(),
                                              [](const StepPlan& step) { return !step.terms.empty(); });
}

}  // namespace nplc::seqc
