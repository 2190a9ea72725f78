#pragma once

#include <array>
#include <optional>

#include "seqc/seqc.h"
#include "views/machine.h"

namespace nplc::seqc {

/// Which step of one table is which of another.
struct StepMatch {
    std::array<std::optional<std::uint8_t>, kStepNumbers> now_of{};     ///< by number in the older table
    std::array<std::optional<std::uint8_t>, kStepNumbers> before_of{};  ///< by number in the newer table
};

/// Step 0 is step 0. Steps that have names on both sides go by name; those left over are the same if they
/// mostly do the same, which makes one renamed. Without names on one side they go by number.
StepMatch match_steps(const Machine& before, const Symbols* names_before, const Machine& now,
                      const Symbols* names_now);

}  // namespace nplc::seqc
