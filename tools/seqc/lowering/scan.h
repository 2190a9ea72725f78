#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "semantics/truth.h"
#include "sequencer/state.h"

namespace nplc::seqc {

enum class CounterChange : std::uint8_t { none, clear, preset, count_down };

/// What one scan of a step does, the last true term deciding (001 §6.1.9).
struct ScanResult {
    std::uint8_t next = 0;                ///< the own step where it stays
    std::optional<std::uint8_t> outputs;  ///< bits 3..0; nothing: they keep their values
    std::uint16_t timer = 0;              ///< preset in milliseconds; 0: none
    CounterChange counter = CounterChange::none;
    std::uint16_t counter_preset = 0;
    std::vector<sequencer::MotorOrder> orders;
    bool operator==(const ScanResult&) const = default;

    /// Nothing but a switch and outputs.
    bool is_quiet() const { return timer == 0 && counter == CounterChange::none && orders.empty(); }
};

/// A step's scan in each of the 1,024 cases of truth.h.
struct StepBehaviour {
    std::uint8_t step = 0;
    std::size_t terms = 0;             ///< that the step has
    std::vector<ScanResult> outcomes;  ///< different ones, in the order of the first case each
    std::array<std::uint16_t, kCases> of_case{};

    const ScanResult& in(std::size_t c) const { return outcomes[of_case[c]]; }
};

/// `terms` may hold those of other steps and the end of a table; they count for nothing.
StepBehaviour behaviour_of(std::uint8_t step, std::span<const sequencer::TermView> terms);

}  // namespace nplc::seqc
