#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/truth.h"
#include "table/step.h"

/// The behaviour of a whole table: any table, not only one from the compiler.
namespace nplc::seqc {

inline constexpr std::size_t kStepNumbers = 64;  // 63 only as the target of a term that a gateway refuses

inline constexpr std::uint8_t kAllOutputs = 0x0F;

/// The known values of the four outputs.
struct KnownOutputs {
    std::uint8_t known = 0;  ///< which bits
    std::uint8_t value = 0;  ///< their values; 0 elsewhere
    bool operator==(const KnownOutputs&) const = default;
};

struct Machine {
    std::size_t terms = 0;  ///< without the end term
    std::array<table::Step, kStepNumbers> steps;
    std::bitset<kStepNumbers> used;       ///< has terms, is step 0, or is the target of a term
    std::bitset<kStepNumbers> reachable;  ///< from power-up, for any inputs, timer and counter
    /// Outputs with which a reachable step is entered from others (step 0: also by power-up).
    std::array<KnownOutputs, kStepNumbers> entered_with;
    /// Outputs that a reachable step has from then on until it is left.
    std::array<KnownOutputs, kStepNumbers> held;
};

/// `table`: whole terms; those after the end term are ignored.
Machine machine_of(std::span<const std::uint8_t> table);

/// An action of a step, and its condition. Not included: staying and at most writing outputs.
struct StepTransition {
    Truth when;
    table::Outcome outcome;          ///< `outputs` only if the following step does not fix them
    std::uint8_t outputs_shown = 0;  ///< the bits of `outcome.outputs` that are not fixed
};

/// In the order of the cases. An action both with and without ERROR is one reaction if it has the same
/// condition, else two.
std::vector<StepTransition> reactions_of(const Machine& machine, std::uint8_t step);

/// How one output depends on the inputs while a step is active and stays.
struct OutputRule {
    enum class Kind : std::uint8_t {
        on,
        follows,  ///< on while the condition is true, else off
        sets,     ///< switched on when it is true, else kept or reset
        resets,
    };
    std::uint8_t bit = 0;
    Kind kind = Kind::on;
    Truth when;
    Truth open;  ///< cases in which the step is left anyway
};

/// Without outputs that are never on.
std::vector<OutputRule> output_rules(const Machine& machine, std::uint8_t step);

/// The common last actions of every transition into a step: ENTRY in a program.
struct Entry {
    std::vector<sequencer::MotorOrder> orders;
    std::uint16_t timer = 0;
    std::uint16_t counter_preset = 0;
};

/// Empty if fewer than two transitions lead into the step, or all come from step 0.
Entry entry_of(const Machine& machine, std::uint8_t step);

/// The common first orders of all transitions from step 0: the values that POWER_UP writes.
std::vector<sequencer::MotorOrder> power_up_orders(const Machine& machine);

}  // namespace nplc::seqc
