#pragma once

#include <vector>

#include "sim/condition.h"

namespace nplc::sim {

/// The units of a value: its own first, then those of the motor and of the program's SCALE.
std::vector<Unit> units_of(Value::Kind kind, const Names& names);
/// `counts, rev or mm`
std::string units_in_words(Value::Kind kind, const Names& names);
/// A word that is usually a unit, whether or not it fits.
bool looks_like_unit(std::string_view word, const Names& names);

}  // namespace nplc::sim
