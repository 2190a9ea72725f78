#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"
#include "semantics/memory.h"
#include "semantics/truth.h"
#include "seqc/diagnostic.h"
#include "sequencer/table.h"
#include "sequencer/term.h"

/// The program with every name resolved and every value worked out.
namespace nplc::seqc {

/// A gateway holds so many at the least, the end included.
inline constexpr std::size_t kTermsEverywhere = sequencer::kMaxTerms;
inline constexpr std::size_t kMostSteps = 61;                         ///< with names; POWER_UP comes on top
inline constexpr std::uint8_t kLastNamed = sequencer::kLastStep - 1;  ///< no NEXT can name step 62

/// What goes to the motor: a FastMAC command or a register value.
struct Send {
    const registers::Register* reg = nullptr;  ///< none: a FastMAC command
    std::uint8_t command = 0;
    std::uint32_t value = 0;
    Span span;
    std::uint8_t set_point = 0;  ///< whose `value` it is, its default: 1 and on; 0: a constant
    bool same_effect(const Send& other) const {
        return reg == other.reg && command == other.command && value == other.value &&
               set_point == other.set_point;
    }
};

/// All that happens in one scan when a condition holds.
struct Action {
    std::optional<std::uint8_t> next;
    std::vector<Send> sends;
    std::optional<std::uint16_t> timer;
    std::optional<std::uint16_t> counter;
    std::uint8_t timer_point = 0;    ///< the set-point that `timer` is of, as in Send
    std::uint8_t counter_point = 0;  ///< and `counter`
    bool clears_counter = false;
    bool counts_down = false;
    std::uint8_t sets = 0;    ///< outputs that SET switches on
    std::uint8_t resets = 0;  ///< and RESET off
    /// Written when `next` is entered, instead of that step's: it is a copy whose OUT .. WHEN goes on.
    std::optional<std::uint8_t> outputs;
    bool timer_by_step = false;    ///< an ENTRY's: the timer is preset by WITHIN or BLINKING
    std::vector<Span> statements;  ///< as written, without NEXT and without those of an ENTRY
    Span span;
    Span next_span;     ///< where `next` is set
    Span timer_span;    ///< where the timer is preset
    Span counter_span;  ///< where the counter is changed
    Span output_span;   ///< where an output is set or reset

    bool presets() const { return timer || counter; }
    bool counts() const { return clears_counter || counts_down; }
    bool switches() const { return sets != 0 || resets != 0; }
    bool is_empty() const { return !next && sends.empty() && !presets() && !counts() && !switches(); }
    bool same_effect(const Action& other) const;
};

/// A branch as it stands in the program, its spans in `action`.
struct RulePart {
    Truth when;
    Action action;
    Span condition = {};
};

/// Rules of one step never hold in the same case.
struct Rule {
    Truth when;
    Action action;
    Span condition = {};  ///< empty where the program wrote none
    std::vector<RulePart> parts = {};
    bool to_copy = false;  ///< goes to another copy of the same step
    bool is_made = false;  ///< by the compiler, to go there
};

/// The register write of a Send that has one.
inline sequencer::FlexStatement write_of(const Send& send) {
    return {
        .reg = send.reg->number,
        .longword = registers::is_32_bit(send.reg->format),
        .low_word = static_cast<std::uint16_t>(send.value),
        .high_word = static_cast<std::uint16_t>(send.value >> 16),
    };
}

struct ConditionalOutput {
    std::uint8_t outputs = 0;
    Truth when;
    Span condition = {};
};

struct RawTerm {
    sequencer::TermBytes bytes;
    Span span;
};

struct StepPlan {
    std::string_view name;
    Span span;
    std::uint8_t number = 0;
    std::uint8_t outputs = 0;
    bool own_error = false;
    bool no_helper = false;  ///< NO_HELPER
    bool is_helper = false;  ///< made by the compiler
    bool is_copy = false;    ///< the same, of a step of the program
    bool takes_set_points = false;
    std::vector<Span> entry;  ///< the statements of ENTRY
    std::vector<ConditionalOutput> conditional;
    std::vector<Rule> rules;
    Memory memory;
    std::vector<std::vector<Rule>> rules_in;  ///< by the state of `memory`; until the copies are made
    std::vector<RawTerm> terms;
};

/// What is written in the scan that goes on to another step. `outputs_of`: of each step by number.
inline std::uint8_t outputs_entered(const Action& action, const std::vector<std::uint8_t>& outputs_of) {
    if (action.outputs) return *action.outputs;
    const std::size_t next = action.next.value_or(outputs_of.size());
    return next < outputs_of.size() ? outputs_of[next] : std::uint8_t{0};
}

/// Goes on to another step.
inline bool leaves(const StepPlan& step, const Rule& rule) {
    return rule.action.next && *rule.action.next != step.number && !rule.to_copy;
}

struct Plan {
    std::vector<StepPlan> steps;  ///< POWER_UP first, if the program has steps at all
    std::vector<RawTerm> terms;
    std::deque<std::string> names;  ///< of steps that the compiler makes
};

/// In the order of the program.
template <class Visit>
void for_each_send(const Plan& plan, const Visit& visit) {
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) {
            for (const Send& send : rule.action.sends) visit(send);
        }
    }
}

}  // namespace nplc::seqc
