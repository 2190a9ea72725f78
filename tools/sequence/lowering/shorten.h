#pragma once

#include <cstddef>
#include <vector>

#include "lowering/lower.h"
#include "lowering/reduced_step.h"

namespace nplc::seqc {

/// Terms for a reduced step, fewer than `fewer_than`; empty if none are found. They may send an order for
/// several branches at once and let a later term decide the next step, or cancel one by naming their own
/// step.
std::vector<LoweredTerm> shorten(const ReducedStep& error_branch, std::size_t fewer_than);

}  // namespace nplc::seqc
