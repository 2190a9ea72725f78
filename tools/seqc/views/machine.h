#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lowering/scan.h"

/// What a table does, seen whole: any table, not only what the compiler makes.
namespace nplc::seqc {

inline constexpr std::size_t kStepNumbers = 64;  // 63 only as the target of a term that a gateway refuses

inline constexpr std::uint8_t kAllOutputs = 0x0F;

/// What is certain of the four outputs.
struct KnownOutputs {
    std::uint8_t known = 0;  ///< which bits
    std::uint8_t value = 0;  ///< theirs; 0 elsewhere
    bool operator==(const KnownOutputs&) const = default;
};

struct Machine {
    std::size_t terms = 0;  ///< without the end
    std::array<StepBehaviour, kStepNumbers> steps;
    std::bitset<kStepNumbers> used;       ///< has terms, is where the power-up begins or where a term leads
    std::bitset<kStepNumbers> reachable;  ///< from power-up, whatever inputs, timer and counter may be
    /// Outputs with which a reachable step is entered from others (step 0: also by power-up)
    std::array<KnownOutputs, kStepNumbers> entered_with;
    /// Outputs that a reachable step has from then on until it is left
    std::array<KnownOutputs, kStepNumbers> held;
};

/// `table`: whole terms; what follows the end term counts for nothing.
Machine machine_of(std::span<const std::uint8_t> table);

/// Something a step does, and when. Not: to stay and at most write outputs.
struct Reaction {
    Truth when;
    ScanResult outcome;              ///< `outputs` only where the step that follows does not fix them
    std::uint8_t outputs_shown = 0;  ///< which bits of `outcome.outputs` it does not fix

    bool only_on_error() const { return (when & ~truth_of_bit(kErrorBit)).none(); }
};

/// In the order of the cases. What is done both with and without ERROR is one reaction if it is done under
/// the same condition, else two.
std::vector<Reaction> reactions_of(const Machine& machine, std::uint8_t step);

/// How one output follows the inputs while a step is active and stays.
struct OutputRule {
    enum class Kind : std::uint8_t {
        on,
        follows,  ///< on while the condition holds, off otherwise
        sets,     ///< written on when it holds, else kept or reset
        resets,
    };
    std::uint8_t bit = 0;
    Kind kind = Kind::on;
    Truth when;
    Truth open;  ///< cases in which the step is left anyway
};

/// Outputs that are never on are left out.
std::vector<OutputRule> output_rules(const Machine& machine, std::uint8_t step);

/// What every way into a step does last: what ENTRY says in a program.
struct Entry {
    std::vector<sequencer::MotorOrder> orders;
    std::uint16_t timer = 0;
    std::uint16_t counter_preset = 0;
};

/// Nothing where fewer than two ways lead into the step, or all of them from step 0.
Entry entry_of(const Machine& machine, std::uint8_t step);

/// The orders with which all that leaves step 0 begins: the values that POWER_UP writes.
std::vector<sequencer::MotorOrder> power_up_orders(const Machine& machine);

}  // namespace nplc::seqc
