#pragma once

#include <string>

#include "registers/mac.h"

namespace nplc::registers_reference {

/// The register map of a model's family as Markdown, for people: tables of the registers, of bits and values,
/// and of what the manual leaves open.
std::string reference(registers::Model model);

/// Name of that file: REGISTERS_MAC50-141.md, REGISTERS_MAC800.md.
std::string file_name(registers::Model model);

}  // namespace nplc::registers_reference
