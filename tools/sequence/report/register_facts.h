#pragma once

#include <optional>
#include <string>

#include "registers/mac.h"
#include "symbols/units.h"

namespace nplc::seqc {

/// "1 mm = 819.2; -41943 .. 41943 mm" in one line: a register's unit and range. `length` is that of SCALE.
std::string register_line(const registers::Register& reg, registers::Model model,
                          const std::optional<LengthUnit>& length);

/// What a program has to know of a register besides its title: unit, range, access, section of the manual,
/// bits and values, and what is unclear in the manual; as a list in Markdown.
std::string register_facts(const registers::Register& reg, registers::Model model,
                           const std::optional<LengthUnit>& length);

}  // namespace nplc::seqc
