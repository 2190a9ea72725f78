#pragma once

#include "registers/mac.h"

namespace nplc::registers {

/// The register numbers of a value. 001 §3.2: a 32-bit register takes its own number (low word) and the next.
/// 004: every register is a longword in one number.
struct Cells {
    std::uint8_t first;
    std::uint8_t count;
};

constexpr bool overlap(Cells a, Cells b) {
    return a.first < b.first + b.count && b.first < a.first + a.count;
}

/// Format on the line: on a MAC800 every register has 32 bits (004).
constexpr Format format_on_line(Model model, const Register& reg) {
    return model == Model::mac800 && !is_32_bit(reg.format) ? Format::long_int : reg.format;
}

/// 2 or 4: length of a write that changes exactly this register.
constexpr std::uint8_t bytes_of(Model model, const Register& reg) {
    return model == Model::mac800 || is_32_bit(reg.format) ? 4 : 2;
}

/// The registers changed by writing `bytes` (2 or 4) to a number. On MAC50-141 four bytes also change the
/// next number, whatever it is: V_SOLL written with four bytes also overwrites A_SOLL.
constexpr Cells cells_of_write(Model model, std::uint8_t number, std::uint8_t bytes) {
    const bool two = model != Model::mac800 && bytes > 2;
    return {number, static_cast<std::uint8_t>(two ? 2 : 1)};
}

/// Width and sign of a number on MAC50-141, 2 or 4 as in bytes_of(), for boards without the register maps.
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

/// The register that contains a number: its own, or the 32-bit one before it. Null: there is no such number.
const Register* holder_of(Model model, std::uint8_t number);

/// Whether a number is only the upper word of the register before it.
bool is_second_half(Model model, std::uint8_t number);

}  // namespace nplc::registers
