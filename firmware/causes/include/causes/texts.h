#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "registers/convert.h"
#include "registers/details.h"
#include "registers/mac.h"

/// A register's value in a readable form.
namespace nplc::causes {

/// A mode, a pointer: one field as wide as the register; null: there is none.
const registers::Field* whole_field(const registers::Register& reg, registers::Model model);
/// In its shown unit.
std::string number_text(const registers::Register& reg, registers::Model model, std::int64_t raw);
/// The unit in which values are shown: counts for positions, which distinguish single steps, else the usual
/// one; empty for a plain number.
std::string_view shown_unit(const registers::Register& reg);
/// "762.94 rpm", "20480 counts", "P_MODE", "IN_POS ACC_FLAG"; names where the register has them, else the
/// number in its shown unit.
std::string value_text(const registers::Register& reg, registers::Model model, std::int64_t raw);
/// The same where there is room: a position in turns too, "20480 counts (5.00000 rev)".
std::string long_value_text(const registers::Register& reg, registers::Model model, std::int64_t raw);
/// As `set` takes it, in one word: "HICLK+INPSIGN", "none"; as 0x.. what has no names.
std::string bits_word(const registers::Register& reg, registers::Model model, std::int64_t raw);
/// The names of bits that are set and of fields' values, "USERINTF=FASTMAC HICLK"; empty for a plain number.
std::string names_text(const registers::Register& reg, registers::Model model, std::int64_t raw);

}  // namespace nplc::causes
