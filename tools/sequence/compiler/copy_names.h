#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/model.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// One copy of a step.
struct CopyKey {
    std::size_t step = 0;    ///< its index in the plan
    std::size_t memory = 0;  ///< state of the step's memory
    std::uint16_t half = 0;  ///< of BLINKING; off in odd ones
    std::uint8_t latched = 0;
    bool is_dark() const { return half % 2 != 0; }
    auto operator<=>(const CopyKey&) const = default;
};

/// Names the copies after their differences, with the reason for each. `made`: in the order of `keys`.
void name_copies(Plan& plan, const std::vector<CopyKey>& keys, std::vector<StepPlan>& made,
                 Compilation& result);

}  // namespace nplc::seqc
