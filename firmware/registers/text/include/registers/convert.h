#pragma once

#include <array>

#include "registers/mac.h"

namespace nplc::registers {

/// The number represented by a register's bits, and the reverse. Bits above the format's width are ignored.
/// Every register of MAC800 has 32.
std::int64_t value_of(Format format, std::uint32_t bits);
std::uint32_t bits_of(Format format, std::int64_t value);

enum class TextError : std::uint8_t {
    none,
    not_a_number,  ///< empty, no number, or two numbers
    too_long,      ///< more than 18 digits, or more than 9 after the point
    wrong_unit,    ///< not one of units_of(), or a unit after bits such as 16#1F
    out_of_range,  ///< below `min` or above `max` of the register
    too_small,     ///< not 0, but rounded to 0 in the register's steps
};

/// A text converted to a register's value.
struct Parsed {
    TextError error = TextError::none;
    std::int64_t raw = 0;  ///< also with out_of_range, if it fits 64 bits at all
    /// Rounding in thousandths of a raw step: raw minus the written value. 0 for up to half a thousandth.
    std::int16_t rounding = 0;
    bool exact = true;  ///< false if anything was rounded, however little
};

/// Reads `1500 rpm`, `12 rev`, `25 %`, `3.5 V`, `-67000000`, `3.9`, `1_000`, `16#1F`, `2#1010`, `8#17`.
/// Without a unit a number is in the register's raw steps, in fixed-point registers the number itself; with a
/// base it is the register's bits. Arithmetic is exact, halves are rounded away from zero. Units:
/// registers/scale.h.
Parsed parse(std::string_view text, const Register& reg, Model model);

/// A short text in the caller's storage.
class Text {
  public:
    std::string_view view() const { return {chars_.data(), size_}; }
    void add(char c) {
        if (size_ < chars_.size()) chars_[size_++] = c;
    }
    void add(std::string_view text) {
        for (const char c : text) add(c);
    }

  private:
    std::array<char, 48> chars_{};
    std::size_t size_ = 0;
};

/// The value in `unit` (registers/scale.h), or in the usual unit of such a register, or as 16#... for bits.
/// With the fewest decimals that distinguish adjacent values plus one digit, so that parse() returns exactly
/// this raw value. A unit that does not fit gives the plain number.
Text to_text(std::int64_t raw, const Register& reg, Model model);
Text to_text(std::int64_t raw, const Register& reg, Model model, std::string_view unit);

}  // namespace nplc::registers
