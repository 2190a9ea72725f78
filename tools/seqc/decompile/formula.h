#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "semantics/truth.h"

namespace nplc::seqc {

/// A condition as people write it.
struct Formula {
    std::string text;  ///< without the NOT ERROR that a condition means by itself
    int cost = 0;      ///< how much there is to read
    bool is_true = false;
};

/// What the bits of a case are called.
using BitNames = std::array<std::string, kBits>;

/// A short formula that holds in all of `need` and in nothing outside of `allowed`, which contains `need`.
/// Short, not the shortest. `need` is not empty.
Formula formula_of(const Truth& need, const Truth& allowed, const BitNames& names);

}  // namespace nplc::seqc
