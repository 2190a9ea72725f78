#pragma once

#include <cstddef>
#include <vector>

#include "terms/small_cubes.h"

namespace nplc::seqc {

struct ListedCube {
    const SmallCubes::Entry* cube = nullptr;
    bool in = false;
};

/// Fewest cubes in a list of which the last that holds a case says whether it is in `set`; a case that none
/// holds is out. Exact up to a bound on the search. Empty if there is none of fewer than `fewer_than`.
std::vector<ListedCube> least_list(SmallSet set, const SmallCubes& cubes, std::size_t fewer_than);

/// Fewest cubes that hold each case of `set` once and no other. Exact. Empty if there are none of fewer than
/// `fewer_than`. `cubes` without zeros.
std::vector<const SmallCubes::Entry*> least_partition(SmallSet set, const SmallCubes& cubes,
                                                      std::size_t fewer_than);

}  // namespace nplc::seqc
