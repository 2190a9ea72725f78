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

/// The effect of one scan of a step; the last true term decides (001 §6.1.9).
struct ScanResult {
    std::uint8_t next = 0;                ///< its own step if it stays
    std::optional<std::uint8_t> outputs;  ///< bits 3..0; empty: unchanged
    std::uint16_t timer = 0;              ///< preset in milliseconds; 0: none
    CounterChange counter = CounterChange::none;
    std::uint16_t counter_preset = 0;
    std::vector<sequencer::MotorOrder> orders;
    bool operator==(const ScanResult&) const = default;

    /// Only a step change and outputs.
    bool is_quiet() const { return timer == 0 && counter == CounterChange::none && orders.empty(); }
};

/// A step's scan in each of the 1,024 cases of truth.h.
struct StepBehaviour {
    std::uint8_t step = 0;
    std::size_t terms = 0;             ///< number of the step's terms
    std::vector<ScanResult> outcomes;  ///< different ones, in the order of the first case of each
    std::array<std::uint16_t, kCases> of_case{};

    const ScanResult& in(std::size_t c) const { return outcomes[of_case[c]]; }
};

/// `terms` may contain those of other steps and the end term, which are ignored.
StepBehaviour behaviour_of(std::uint8_t step, std::span<const sequencer::TermView> terms);

}  // namespace nplc::seqc
