#pragma once

#include <cstdint>
#include <vector>

#include "support.h"

namespace nplc::seqc::test {

/// A table that a gateway takes: `terms` terms of steps below `steps`, few bits compared, so that much
/// happens.
std::vector<std::uint8_t> random_table(Random& random, unsigned steps, unsigned terms);

}  // namespace nplc::seqc::test
