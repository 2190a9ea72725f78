#pragma once

#include <array>

#include "compiler/model.h"

namespace nplc::seqc {

/// Data-flow analysis of the motor from step to step until nothing changes, then judges each rule. A Walk has
///   State                      is_known(): some way leads here; join(other): true if that was news
///   enter(state, step, rule)   what is known besides where the rule's condition holds
///   apply(state, send)         what holds once this was sent
///   judge(rule, state)         called once for each rule of the steps that are reached
template <class Walk>
void walk_steps(const Plan& plan, const typename Walk::State& at_power_up, Walk& walk) {
    using State = typename Walk::State;
    std::array<State, sequencer::kLastStep + 1U> states{};
    states[0] = at_power_up;
    const auto for_each_rule = [&](const auto& visit) {
        for (const StepPlan& step : plan.steps) {
            if (!states[step.number].is_known()) continue;
            for (const Rule& rule : step.rules) {
                State state = states[step.number];
                walk.enter(state, step, rule);
                visit(step, rule, state);
            }
        }
    };
    for (bool changed = true; changed;) {
        changed = false;
        for_each_rule([&](const StepPlan& step, const Rule& rule, State& state) {
            for (const Send& send : rule.action.sends) walk.apply(state, send);
            changed = states[rule.action.next.value_or(step.number)].join(state) || changed;
        });
    }
    for_each_rule([&](const StepPlan&, const Rule& rule, State& state) { walk.judge(rule, state); });
}

}  // namespace nplc::seqc
