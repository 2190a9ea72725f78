#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/truth.h"

namespace nplc::seqc {

/// A condition in readable form.
struct Formula {
    std::string text;  ///< without the implicit NOT ERROR of a condition
    int cost = 0;      ///< reading effort
    bool is_true = false;
};

/// The names of a case's bits.
struct BitNames {
    std::array<std::string, kBits> name;
    unsigned inverted = 0;  ///< a bit for each input whose name holds while the bit is off
};

/// A short formula that is true in all of `need` and in nothing outside of `allowed`, which contains `need`.
/// Not guaranteed to be the shortest. `need` is not empty.
Formula formula_of(const Truth& need, const Truth& allowed, const BitNames& names);

}  // namespace nplc::seqc
