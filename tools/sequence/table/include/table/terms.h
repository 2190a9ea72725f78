#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sequencer/term.h"

/// The meaning of one term, read from its bytes.
namespace nplc::table {

/// A bit of the key (step.h: HW_INP in bits 7..0, timer = 0 in bit 8, counter = 0 in bit 9), and its value.
struct Compared {
    unsigned key_bit = 0;
    bool level = false;
};

inline constexpr unsigned kInPosBit = 6;
inline constexpr unsigned kErrorBit = 7;
inline constexpr unsigned kTimerZero = 8;
inline constexpr unsigned kCounterZero = 9;

/// What a term compares: inputs, IN_POS, timer, counter, and always ERROR, the last.
std::vector<Compared> compared_by(sequencer::TermView term);

/// What makes a gateway refuse a table with the term.
enum class TermFault : std::uint8_t { none, next_is_63, register_0 };
TermFault fault_of(sequencer::TermView term);

/// What a program of statements never makes, in the order in which it is looked for.
enum class Oddity : std::uint8_t {
    none,
    of_step_62,           ///< no step can have this number
    level_without_care,   ///< INPUT has a level that CARE masks
    next_is_63,           ///< a gateway refuses the table
    unused_bits,          ///< AVAILABLE bits are set
    command_not_sent,     ///< a command with FAST_DIS = 1
    counter_preset_of_0,  ///< CNT_TIME = 1 and nothing to preset
    register_0,           ///< a gateway refuses the table
    upper_word_not_sent,  ///< of 16 bits, with a nonzero upper word
};
Oddity oddity_of(sequencer::TermView term);

/// Where the value of a term goes.
struct ValuePlace {
    enum class Kind : std::uint8_t { timer, counter, reg } kind = Kind::timer;
    std::uint8_t reg = 0;  ///< number of the register
    bool operator==(const ValuePlace&) const = default;
};
ValuePlace value_place(sequencer::TermView term);
/// The preset, 0 for none, or what is written to the register.
std::uint32_t value_of(sequencer::TermView term);
/// Bits that the term does not hold are cut.
void set_value(std::span<std::uint8_t, sequencer::kTermBytes> term, std::uint32_t value);

/// The bytes in hexadecimal, each as "C0 ".
std::string hex(sequencer::TermView term);

}  // namespace nplc::table
