#pragma once

#include <string>

#include "registers/details.h"
#include "registers/mac.h"

namespace nplc::registers_reference {

std::string registers_by_group(registers::Model model);
std::string bits_and_values(registers::Model model);

/// Where GitHub and others put the heading of a register's bits.
std::string anchor(const registers::Register& reg);
/// `|` would end a cell.
std::string cell(std::string_view text);

}  // namespace nplc::registers_reference
