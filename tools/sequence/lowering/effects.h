#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiler/model.h"
#include "compiler/truth.h"
#include "lowering/lower.h"

namespace nplc::seqc {

/// The effect of the terms for one kind of case: a rule's action, or outputs only, together with the outputs.
struct Effect {
    const Action* action = nullptr;  ///< null: outputs only
    std::uint8_t outputs = 0;
    std::uint8_t own_step = 0;
    bool stays = false;           ///< names its own step as the next, to cancel an earlier term's
    bool writes_outputs = false;  ///< needs a FastMAC-format term even without other effects
    Truth fired;                  ///< cases in which one of its terms is true
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

/// How outputs that depend on the timer or the counter are combined with a branch's orders while the step
/// stays.
enum class Outputs : std::uint8_t {
    along,  ///< a separate effect for each
    apart,  ///< one effect, with the outputs for a running timer and counter; later terms correct them
};

Effects effects_of(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                   Outputs outputs = Outputs::along);

/// Appends the terms of one effect under one condition: commands in order, each FastMAC-format one with the
/// same next step and outputs, since the last one decides.
void append_terms(const Effect& effect, const sequencer::Condition& condition,
                  std::vector<LoweredTerm>& terms);

}  // namespace nplc::seqc
