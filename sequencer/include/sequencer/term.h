#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::sequencer {

/// The 8-byte sequence term (001 §6.1.4 - §6.1.8).
inline constexpr std::size_t kTermBytes = 8;
inline constexpr std::uint8_t kLastStep = 62;
inline constexpr std::uint8_t kNoSwitch = 0x3E;    ///< NEXT_STATE that names no step
inline constexpr std::uint8_t kEndOfTable = 0x3F;  ///< STATE that ends the table

/// HW_INP (001 §6.1.9): inputs in bits 5..0, IN_POS in bit 6, ERROR in bit 7.
using InputImage = std::uint8_t;
inline constexpr InputImage kInputsMask = 0x3F;
inline constexpr InputImage kInPos = 0x40;
inline constexpr InputImage kError = 0x80;

using TermBytes = std::array<std::uint8_t, kTermBytes>;
using TermView = std::span<const std::uint8_t, kTermBytes>;

/// Bytes 0..2: STATE, INPUT and CARE without CMD_FORMAT (001 §6.1.5).
struct Condition {
    std::uint8_t step = 0;            ///< 0..62; 63 ends the table
    bool needs_counter_zero = false;  ///< COUNTER_BIT = 0
    bool needs_timer_zero = false;    ///< TIMER_BIT = 0
    InputImage input = 0;             ///< wanted levels; bit 7 (ERROR) is always compared
    std::uint8_t care = 0;            ///< which of input bits 6..0 are compared; 7 bits
    bool operator==(const Condition&) const = default;
};

/// Bytes 3..7 with CMD_FORMAT = 0 (001 §6.1.7).
struct FastStatement {
    std::uint8_t next_step = kNoSwitch;
    bool presets_counter = false;      ///< CNT_TIME: `preset` is for the counter, else for the timer
    bool sends = false;                ///< FAST_DIS = 0
    std::uint8_t command = 0;          ///< FastMAC command without the toggle bit; 7 bits, kept when not sent
    std::uint8_t outputs = 0;          ///< 4 bits
    bool clears_counter = false;       ///< CLR_CNT
    bool counts_down = false;          ///< CNT_DWN
    std::uint16_t preset = 0;          ///< milliseconds or counts; 0 presets nothing
    bool available_next_bit7 = false;  ///< unused by the manual, kept
    std::uint8_t available_outputs = 0;  ///< OUTPUT bits 5..4, unused by the manual, kept; 2 bits
    bool operator==(const FastStatement&) const = default;
};

/// Bytes 3..7 with CMD_FORMAT = 1 (001 §6.1.8).
struct FlexStatement {
    std::uint8_t reg = 0;  ///< 1..127
    bool longword = false;
    std::uint16_t low_word = 0;
    std::uint16_t high_word = 0;  ///< sent only with `longword`, kept otherwise
    bool operator==(const FlexStatement&) const = default;
};

struct Term {
    Condition condition;
    bool is_flex = false;
    FastStatement fast;  ///< meaningful when !is_flex
    FlexStatement flex;  ///< meaningful when is_flex
    bool operator==(const Term&) const = default;
};

/// Every 8 bytes decode to a Term; nothing is lost: encode(decode(b)) == b.
Term decode(TermView bytes);

/// Fields wider than their bits are cut to them.
TermBytes encode(const Term& term);

/// Single bits of a term, for whoever has no use for the rest.
constexpr std::uint8_t step_of(TermView bytes) {
    return bytes[0] & 0x3F;
}
constexpr bool is_flex(TermView bytes) {
    return (bytes[2] & 0x80) != 0;
}
/// A register write, or a FastMAC command that is not disabled.
constexpr bool has_order(TermView bytes) {
    return is_flex(bytes) || (bytes[4] & 0x80) == 0;
}
constexpr bool is_end(TermView bytes) {
    return step_of(bytes) == kEndOfTable;
}

}  // namespace nplc::sequencer
