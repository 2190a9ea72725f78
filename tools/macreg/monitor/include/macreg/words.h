#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "registers/mac.h"

/// What registers and bytes are called in lines for people.
namespace nplc::macreg {

/// "P_IST (10)"; "upper word of P_IST (11)", "register 200" for numbers that are no register's own.
std::string register_words(registers::Model model, std::uint8_t number);

/// The unit that lines, recordings and the screen show: the usual one, encoder counts for lengths; empty for
/// plain numbers and bits.
std::string_view shown_unit(const registers::Register& reg);

/// "4660 counts", "300 rpm"; modes and pointers with their name, bits with the names of those that are set.
std::string value_words(registers::Model model, const registers::Register& reg, std::int64_t raw);

/// The value of a register read or written with so many bytes: "00001234 = 4660 counts", "0002 = P_MODE". The
/// bytes beyond the register's own width are left out.
std::string bytes_words(registers::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes);

/// "50 50 50 08 F7"
std::string hex_words(std::span<const std::uint8_t> bytes);

}  // namespace nplc::macreg
