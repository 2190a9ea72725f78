#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "set_points/record.h"

/// Values of set-points as people write them.
namespace nplc::set_points {

/// In the unit, as short a number as tells it from its neighbours: 80, not 79.998.
double shown_value(const SetPoint& point, std::int32_t value);
/// The nearest steps to a number in the unit; nothing: 32 bits do not hold it.
std::optional<std::int32_t> steps_of(const SetPoint& point, double number);
/// Digits behind the point that a value of it needs: those of STEP, or those that tell neighbours apart; 6 at
/// the most, and so few that every value of the range times 10^digits fits into 32 bits.
unsigned decimals_of(const SetPoint& point);
/// "80 mm": in the unit, with as many digits as tell it from its neighbours.
std::string text_of(const SetPoint& point, std::int32_t value);
/// "10 mm to 200 mm in steps of 0.1 mm"
std::string range_text(const SetPoint& point);

struct Reading {
    std::int32_t value = 0;
    std::string error;  ///< what is wrong, with the name and the limits; empty if nothing
};

/// "80", "80 mm", "80mm": the unit of the set-point, or none; of times ms and s too. Refused: what is no
/// number, another unit, what lies outside of the range, a count that is no whole number, and what is no
/// whole number of the STEP from the lower end on.
Reading read_value(const SetPoint& point, std::string_view text);

}  // namespace nplc::set_points
