#pragma once

#include <cstddef>
#include <vector>

#include "terms/half.h"
#include "terms/lower.h"

namespace nplc::seqc {

/// Terms for one half of a step, fewer than `fewer_than`; empty if none are found. They may send an order
/// for several branches at once and let a later term decide the next step, or undo one by naming their own
/// step.
std::vector<LoweredTerm> shorten(const Half& half, std::size_t fewer_than);

}  // namespace nplc::seqc
