#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"
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
    bool same_effect(const Send& other) const {
        return reg == other.reg && command == other.command && value == other.value;
    }
};

/// All that happens in one scan when a condition holds.
struct Action {
    std::optional<std::uint8_t> next;
    std::vector<Send> sends;
    std::optional<std::uint16_t> timer;
    std::optional<std::uint16_t> counter;
    bool clears_counter = false;
    bool counts_down = false;
    Span span;
    Span next_span;     ///< where `next` is set
    Span timer_span;    ///< where the timer is preset
    Span counter_span;  ///< where the counter is changed

    bool presets() const { return timer || counter; }
    bool counts() const { return clears_counter || counts_down; }
    bool is_empty() const { return !next && sends.empty() && !presets() && !counts(); }
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
    std::vector<ConditionalOutput> conditional;
    std::vector<Rule> rules;
    std::vector<RawTerm> terms;
};

/// Goes on to another step.
inline bool leaves(const StepPlan& step, const Rule& rule) {
    return rule.action.next && *rule.action.next != step.number;
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
