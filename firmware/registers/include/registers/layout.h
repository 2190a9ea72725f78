#pragma once

#include "registers/mac.h"

namespace nplc::registers {

/// The register numbers that a value takes. 001 §3.2: a 32-bit register takes its own number (low word) and
/// the next. 004: every register is a longword in one number.
struct Cells {
    std::uint8_t first;
    std::uint8_t count;
};

constexpr bool overlap(Cells a, Cells b) {
    return a.first < b.first + b.count && b.first < a.first + a.count;
}

/// How its value stands on the line: on a MAC800 every register has 32 bits (004).
constexpr Format format_on_line(Model model, const Register& reg) {
    return model == Model::mac800 && !is_32_bit(reg.format) ? Format::long_int : reg.format;
}

/// 2 or 4: what a master writes so that this register changes, all of it, and no other.
constexpr std::uint8_t bytes_of(Model model, const Register& reg) {
    return model == Model::mac800 || is_32_bit(reg.format) ? 4 : 2;
}

/// Where `bytes` (2 or 4) written to a number end up. On MAC50-141 four bytes reach the next number too,
/// whatever it holds: V_SOLL written with four bytes also overwrites A_SOLL.
constexpr Cells cells_of_write(Model model, std::uint8_t number, std::uint8_t bytes) {
    const bool two = model != Model::mac800 && bytes > 2;
    return {number, static_cast<std::uint8_t>(two ? 2 : 1)};
}

/// 2 or 4 as bytes_of(), and whether it has a sign, of a number on MAC50-141: what a board that has no room
/// for the maps knows of them.
struct Width {
    std::uint8_t bytes;
    bool is_signed;
};
Width small_width_of(std::uint8_t number);

/// The bits of ERR_STAT that are settings, not errors (001 §3.2.35; 004).
constexpr std::uint32_t settings_of_err_stat(Model model) {
    return model == Model::mac800 ? 1U << 14 : 0x4600U;
}

constexpr Cells cells_of(Model model, const Register& reg) {
    return cells_of_write(model, reg.number, bytes_of(model, reg));
}

/// The register that a number belongs to: its own, or the 32-bit one before it. None: the map has no such
/// number.
const Register* holder_of(Model model, std::uint8_t number);

/// A number that is only the upper word of the register before it.
bool is_second_half(Model model, std::uint8_t number);

}  // namespace nplc::registers
