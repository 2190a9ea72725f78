#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"

namespace nplc::seqc {

/// How far the machine moves in one revolution, from SCALE.
struct LengthUnit {
    std::string_view name;
    double per_revolution = 1;
};

/// A register's raw steps per `unit`; empty if the unit does not fit the register. An empty unit is the raw
/// step itself, and for the fixed-point formats the number 1.
std::optional<double> raw_per_unit(const registers::Register& reg, registers::Model model,
                                   const std::optional<LengthUnit>& length, std::string_view written);

/// The units that fit a register.
std::vector<std::string> fitting_units(const registers::Register& reg,
                                       const std::optional<LengthUnit>& length);

/// Whether any register accepts it.
bool is_known_unit(std::string_view unit);

/// The units that fit a register, for messages.
std::string units_for(const registers::Register& reg, const std::optional<LengthUnit>& length);

/// A value in a unit that a register takes.
struct Converted {
    double number = 0;
    std::string unit;
};

/// The value in one of `fitting`, if its unit is none of them but a multiple of one: cm where mm is taken,
/// m/min where mm/s is.
std::optional<Converted> converted(double number, std::string_view unit,
                                   const std::vector<std::string>& fitting);

}  // namespace nplc::seqc
