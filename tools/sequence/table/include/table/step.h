#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sequencer/state.h"

/// What a table does, read from its bytes: each step in every case.
namespace nplc::table {

/// A case is a sequencer::Key: HW_INP in bits 7..0, timer = 0 in bit 8, counter = 0 in bit 9.
using Cases = std::bitset<sequencer::kKeys>;

inline constexpr unsigned kKeyBits = 10;
const Cases& cases_with(unsigned key_bit);

/// The cases in which a term is true.
Cases cases_of(sequencer::TermView term);

enum class CounterChange : std::uint8_t { none, clear, preset, count_down };

/// The effect of one scan of a step; the last true term decides (001 §6.1.9).
struct Outcome {
    std::uint8_t next = 0;                ///< its own step if it stays
    std::optional<std::uint8_t> outputs;  ///< bits 3..0; empty: unchanged
    std::uint16_t timer = 0;              ///< preset in milliseconds; 0: none
    CounterChange counter = CounterChange::none;
    std::uint16_t counter_preset = 0;
    std::vector<sequencer::MotorOrder> orders;
    bool operator==(const Outcome&) const = default;

    bool sends() const { return !orders.empty(); }
    /// Only a step change and outputs.
    bool is_quiet() const { return timer == 0 && counter == CounterChange::none && !sends(); }
    bool sets_counter() const { return counter == CounterChange::clear || counter == CounterChange::preset; }

    /// The state after a scan that began in `state`, before any time passes.
    void apply(sequencer::State& state) const {
        state.step = next;
        if (outputs) state.outputs = *outputs;
        if (timer != 0) state.timer = timer;
        if (sets_counter()) {
            state.counter = counter_preset;
        } else if (counter == CounterChange::count_down && state.counter != 0) {
            --state.counter;
        }
    }
};

/// A step in each case.
struct Step {
    std::uint8_t number = 0;
    std::size_t terms = 0;                      ///< number of the step's terms
    std::uint8_t compared = sequencer::kError;  ///< bits of HW_INP that some of them compare
    /// In the order of the first case of each. Two may be equal if their orders are in different terms.
    std::vector<Outcome> outcomes;
    std::array<std::uint16_t, sequencer::kKeys> of_case{};

    const Outcome& in(std::size_t key) const { return outcomes[of_case[key]]; }
};

/// `terms` may contain those of other steps and the end term, which are ignored.
Step step_of(std::uint8_t step, std::span<const sequencer::TermView> terms);

/// The terms in front of the end term, where they lie.
std::vector<sequencer::TermView> terms_of(std::span<const std::uint8_t> table);

/// In bytes, with the end term; 0 if there is none.
std::size_t length_of(std::span<const std::uint8_t> table);

}  // namespace nplc::table
