#pragma once

#include <vector>

#include "sim/condition.h"

namespace nplc::sim {

/// The units of a value: its own first, then those of the motor and of the program's SCALE.
std::vector<Unit> units_of(Value::Kind kind, const Names& names);
std::vector<Unit> units_of(const set_points::SetPoint& point);
/// `counts, rev or mm`
std::string units_in_words(Value::Kind kind, const Names& names);
/// A word behind a number that is intended as a unit, valid or not; false for words of the language.
bool is_meant_as_unit(std::string_view word, const Names& names);
/// For a unit that does not fit: ` (90 cm are 900 mm)`, ` (Speed has rpm)`, or nothing. `of`: the value.
std::string unit_hint(double number, std::string_view unit, const std::vector<Unit>& fitting, const Value& of,
                      const Names& names);

}  // namespace nplc::sim
