#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lowering/lower.h"
#include "semantics/model.h"
#include "semantics/truth.h"

namespace nplc::seqc {

/// What the terms of one kind of case do: a rule's action, or only outputs, with the outputs written along.
struct Effect {
    const Action* action = nullptr;  ///< none: outputs only
    std::uint8_t outputs = 0;
    std::uint8_t own_step = 0;
    bool stays = false;           ///< names its own step as the next, to undo a term before it
    bool writes_outputs = false;  ///< needs a FastMAC-format term even if nothing else does
    Truth fired;                  ///< cases in which one of its terms holds
    Span span;

    bool is_hard() const { return action != nullptr || stays; }
    bool next() const { return action != nullptr && action->next.has_value(); }
    bool acts_once() const { return action != nullptr && !action->sends.empty(); }
    bool cannot_be_undone() const {
        return action != nullptr && (!action->sends.empty() || action->presets());
    }
};

/// A step's behaviour, case by case.
struct Effects {
    std::vector<Effect> list;
    std::array<int, kCases> target{};            ///< index into `list`; -1: no term needed
    std::array<std::uint8_t, kCases> resting{};  ///< outputs while the step stays
};

/// How outputs that follow the timer or the counter go with what a branch sends while the step stays.
enum class Outputs : std::uint8_t {
    along,  ///< an effect for each
    apart,  ///< one effect, with the outputs of a timer and a counter that run; later terms mend them
};

Effects effects_of(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                   Outputs outputs = Outputs::along);

/// The terms that carry one effect under one condition: commands in order, each FastMAC-format one with the
/// same next step and outputs, since the last of them wins.
void append_terms(const Effect& effect, const sequencer::Condition& condition,
                  std::vector<LoweredTerm>& terms);

}  // namespace nplc::seqc
