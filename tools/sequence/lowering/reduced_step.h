#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/model.h"
#include "compiler/truth.h"

namespace nplc::seqc {

/// The required behaviour in one case.
struct Behaviour {
    const Action* action = nullptr;  ///< null: outputs only
    std::uint8_t next = 0;           ///< the step at the end of the scan
    std::uint8_t outputs = 0;
    bool leaves = false;
    bool writes = false;  ///< outputs or counter bits must be written
    bool operator==(const Behaviour&) const = default;

    std::uint16_t timer() const { return action != nullptr ? action->timer.value_or(0) : std::uint16_t{0}; }
    std::uint16_t counter() const {
        return action != nullptr ? action->counter.value_or(0) : std::uint16_t{0};
    }
    /// Outputs and counter bits as written by a FastMAC-format term (byte OUTPUT of 001 §6.1.7).
    std::uint8_t output_byte() const;
    std::size_t sends() const { return action != nullptr ? action->sends.size() : 0; }
};

/// One step with ERROR fixed, reduced to the bits on which its behaviour depends. ERROR is always compared,
/// so no term of the one with ERROR acts in the one without.
struct ReducedStep {
    bool error = false;
    const StepPlan* step = nullptr;
    std::vector<std::uint8_t> bits;  ///< of truth.h, ascending
    std::size_t inputs = 0;          ///< number of `bits` that are inputs or IN_POS; the rest are zero flags
    std::vector<Behaviour> behaviours;
    std::vector<std::uint16_t> wanted;  ///< index into `behaviours`, by reduced case

    std::size_t cases() const { return wanted.size(); }
    const Behaviour& at(std::size_t reduced) const { return behaviours[wanted[reduced]]; }
};

std::array<ReducedStep, 2> error_branches_of(const StepPlan& step,
                                             const std::vector<std::uint8_t>& outputs_of);

}  // namespace nplc::seqc
