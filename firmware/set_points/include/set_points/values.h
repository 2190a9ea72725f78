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
/// "80 mm": in the unit, with as many digits as distinguish adjacent values.
std::string text_of(const SetPoint& point, std::int32_t value);
/// "10 mm to 200 mm in steps of 0.1 mm"
std::string range_text(const SetPoint& point);

struct Reading {
    std::int32_t value = 0;
    std::string error;  ///< the error, with the name and the limits; empty if valid
};

/// "80", "80 mm", "80mm": in the unit of the set-point, or without; for times also ms and s. Errors: no
/// number, another unit, out of range, a fractional count, or not a multiple of STEP from the lower end on.
Reading read_value(const SetPoint& point, std::string_view text);

}  // namespace nplc::set_points
