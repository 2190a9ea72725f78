#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "set_points/record.h"

/// Text form of set-point values.
namespace nplc::set_points {

/// In the unit, with the fewest digits that distinguish adjacent values: 80, not 79.998.
double shown_value(const SetPoint& point, std::int32_t value);
/// The nearest raw value for a number in the unit; empty if it does not fit in 32 bits.
std::optional<std::int32_t> steps_of(const SetPoint& point, double number);
/// Decimals that its values need: those of STEP, or those that distinguish adjacent values; at most 6, and so
/// few that every value of the range times 10^decimals fits in 32 bits.
unsigned decimals_of(const SetPoint& point);
/// A value is on the grid of STEP if it is what a step in the unit, from the lower end as it was written on,
/// rounds to. True without STEP.
bool is_on_grid(const SetPoint& point, std::int32_t value);
/// "1200 or 1300": the steps next to a value that is on none, in the unit; only the one before it where the
/// other is outside of the range.
std::string grid_beside(const SetPoint& point, std::int32_t value);
/// "80 mm": in the unit, with as many digits as distinguish it from its neighbours.
std::string text_of(const SetPoint& point, std::int32_t value);
/// The fewest digits that are read as this value; a STEP's own number may have more.
std::string short_text_of(const SetPoint& point, std::int32_t value);
/// "10 mm to 200 mm in steps of 0.1 mm"
std::string range_text(const SetPoint& point);

struct Reading {
    std::int32_t value = 0;
    std::string error;  ///< the error, with the name and the limits; empty if valid
};

/// "80", "80 mm", "80mm": in the unit of the set-point or without one; for times also ms and s. Refused: no
/// number, another unit, a value outside of the range, a count that is not whole, and a value that is not on
/// the grid.
Reading read_value(const SetPoint& point, std::string_view text);

}  // namespace nplc::set_points
