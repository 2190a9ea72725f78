#pragma once

#include <cstddef>
#include <vector>

#include "lowering/ternary.h"

namespace nplc::seqc {

struct ListedCube {
    Product cube;
    bool in = false;
};

/// Minimum list of cubes in which the last one that contains a case decides whether it is in `set`; a case in
/// none is out. Exact up to a search limit. Empty if there is none of fewer than `fewer_than`.
std::vector<ListedCube> least_list(SmallSet set, const Ternary& cubes, std::size_t fewer_than);

}  // namespace nplc::seqc
