#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "registers/mac.h"

/// What registers and bytes are called in lines for people.
namespace nplc::macreg {

/// "P_IST (10)"; "upper word of P_IST (11)", "register 200" for numbers that are no register's own.
std::string register_words(registers::Model model, std::uint8_t number);

/// The value of a register read or written with so many bytes: "00001234 = 4660 counts", "0002 = P_MODE". The
/// bytes beyond the register's own width are left out.
std::string bytes_words(registers::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes);

/// "50 50 50 08 F7"
std::string hex_words(std::span<const std::uint8_t> bytes);

}  // namespace nplc::macreg
