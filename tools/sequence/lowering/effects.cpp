#include "lowering/effects.h"

#include <algorithm>

#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

using sequencer::FastStatement;
using sequencer::Term;

/// Index of the effect of `action` with `outputs`, added if it is new.
int effect_for(std::vector<Effect>& list, const Action* action, std::uint8_t outputs, const StepPlan& step) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i].action == action && list[i].outputs == outputs) return static_cast<int>(i);
    }
    Effect effect;
    effect.action = action;
    effect.outputs = outputs;
    effect.own_step = step.number;
    effect.writes_outputs = !step.conditional.empty();
    effect.span = action != nullptr ? action->span : step.span;
    list.push_back(effect);
    return static_cast<int>(list.size()) - 1;
}

}  // namespace

Effects effects_of(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of, Outputs outputs) {
    constexpr std::size_t kZeros = std::size_t{1} << kTimerZero | std::size_t{1} << kCounterZero;
    Effects effects;
    effects.target.fill(-1);
    effects.resting.fill(step.outputs);
    for (const ConditionalOutput& conditional : step.conditional) {
        const Truth& when = conditional.when;
        for (std::size_t c = when._Find_first(); c < kCases; c = when._Find_next(c))
            effects.resting[c] |= conditional.outputs;
    }
    for (const Rule& rule : step.rules) {
        const bool leaves = rule.action.next && *rule.action.next != step.number;
        const std::uint8_t entered = outputs_entered(rule.action, outputs_of);
        const bool apart = outputs == Outputs::apart && (!rule.action.sends.empty() || rule.action.presets());
        for (std::size_t c = rule.when._Find_first(); c < kCases; c = rule.when._Find_next(c)) {
            const std::uint8_t resting = effects.resting[apart ? c & ~kZeros : c];
            effects.target[c] = effect_for(effects.list, &rule.action, leaves ? entered : resting, step);
        }
    }
    if (step.conditional.empty()) return effects;
    for (std::size_t c = 0; c < kCases; ++c) {
        if (effects.target[c] == -1)
            effects.target[c] = effect_for(effects.list, nullptr, effects.resting[c], step);
    }
    return effects;
}

void append_terms(const Effect& effect, const sequencer::Condition& condition,
                  std::vector<LoweredTerm>& terms) {
    static const Action kNothing{};
    const Action& action = effect.action != nullptr ? *effect.action : kNothing;
    FastStatement common;
    common.next_step = action.next ? *action.next : effect.stays ? effect.own_step : sequencer::kNoSwitch;
    common.outputs = effect.outputs;
    common.clears_counter = action.clears_counter;
    common.counts_down = action.counts_down;

    std::vector<Term> made;
    std::vector<Span> spans;
    const auto add = [&](const Term& term, Span span) {
        made.push_back(term);
        made.back().condition = condition;
        spans.push_back(span);
    };
    const auto add_fast = [&](Span span) {
        Term term;
        term.fast = common;
        add(term, span);
        return &made.back().fast;
    };
    for (const Send& send : action.sends) {
        if (send.reg != nullptr) {
            Term term;
            term.is_flex = true;
            term.flex = write_of(send);
            add(term, send.span);
        } else {
            FastStatement* fast = add_fast(send.span);
            fast->sends = true;
            fast->command = send.command;
        }
    }
    const auto is_fast = [](const Term& term) { return !term.is_flex; };
    const auto fast_terms = [&] { return std::count_if(made.begin(), made.end(), is_fast); };
    const int presets = (action.timer ? 1 : 0) + (action.counter ? 1 : 0);
    const bool needs_fast =
        action.next || effect.stays || effect.writes_outputs || action.counts() || effect.action == nullptr;
    while (fast_terms() < std::max(presets, needs_fast ? 1 : 0)) add_fast(effect.span);

    auto carrier = std::find_if(made.begin(), made.end(), is_fast);
    if (action.timer) {
        carrier->fast.preset = *action.timer;
        carrier = std::find_if(carrier + 1, made.end(), is_fast);
    }
    if (action.counter) {
        carrier->fast.presets_counter = true;
        carrier->fast.preset = *action.counter;
    }
    for (std::size_t i = 0; i < made.size(); ++i) terms.push_back({sequencer::encode(made[i]), spans[i]});
}

}  // namespace nplc::seqc
