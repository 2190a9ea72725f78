#pragma once

#include <vector>

#include "lowering/lower.h"

namespace nplc::seqc {

/// The terms of a step, each branch separately: the starting point of `lower`. Raw terms of the step come
/// last.
std::vector<LoweredTerm> plain_terms(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of);

}  // namespace nplc::seqc
