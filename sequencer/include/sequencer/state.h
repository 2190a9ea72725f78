#pragma once

#include <cstdint>

#include "sequencer/term.h"

namespace nplc::sequencer {

/// What the sequence machine remembers between scans. All 0 at power-up.
struct State {
    std::uint8_t step = 0;
    std::uint8_t outputs = 0;  ///< bits 3..0
    std::uint16_t timer = 0;   ///< milliseconds, runs down to 0 and stays
    std::uint16_t counter = 0;
    bool operator==(const State&) const = default;
};

/// A command or register write of a true term; sent at once, in table order (001 §6.1.9). What a drive is
/// ordered, too: those that speak another language translate.
struct MotorOrder {
    bool is_register_write = false;  ///< FlexMAC, else a FastMAC command
    std::uint8_t command = 0;        ///< bits 6..0
    std::uint8_t reg = 0;
    bool longword = false;
    std::uint32_t value = 0;
    bool operator==(const MotorOrder&) const = default;
};

/// The order in a term; only for terms that have one (FlexMAC format, or FAST_DIS = 0).
MotorOrder order_of(TermView term);

/// The temporary command registers of one scan (001 §6.1.9, item 2). Each true term in FastMAC format is
/// folded in; the last one wins, field by field.
struct Pending {
    std::uint8_t next_step = kNoSwitch;
    std::uint8_t output_byte = 0;  ///< outputs, CLR_CNT, CNT_DWN as they stand in the term
    bool has_output = false;
    std::uint16_t timer_preset = 0;
    std::uint16_t counter_preset = 0;
    bool operator==(const Pending&) const = default;

    void fold(TermView fast_term) {
        const std::uint8_t next = fast_term[3] & 0x3F;
        if (next != kNoSwitch) next_step = next;
        output_byte = fast_term[5];
        has_output = true;
        const auto preset = static_cast<std::uint16_t>(fast_term[6] | (fast_term[7] << 8));
        if (preset == 0) return;
        ((fast_term[3] & 0x40) != 0 ? counter_preset : timer_preset) = preset;
    }
};

/// Executes the temporary registers (item 3): clear beats preset beats decrement. True if anything was
/// written that a repeat of the scan could see.
inline bool apply(const Pending& pending, State& state) {
    if (!pending.has_output) return false;
    const State before = state;
    if (pending.next_step != kNoSwitch) state.step = pending.next_step;
    state.outputs = pending.output_byte & 0x0F;
    if ((pending.output_byte & 0x40) != 0) {
        state.counter = 0;
    } else if (pending.counter_preset != 0) {
        state.counter = pending.counter_preset;
    } else if ((pending.output_byte & 0x80) != 0 && state.counter != 0) {
        --state.counter;
    }
    if (pending.timer_preset != 0) state.timer = pending.timer_preset;
    return pending.timer_preset != 0 || state != before;
}

/// Takes `milliseconds` off the timer (item 4).
inline void elapse(State& state, std::uint32_t milliseconds) {
    if (state.timer == 0) return;
    state.timer = milliseconds >= state.timer ? std::uint16_t{0}
                                              : static_cast<std::uint16_t>(state.timer - milliseconds);
}

/// The ten condition bits that every term of a step tests: HW_INP, and whether timer and counter are 0.
/// Bits 7..0 HW_INP, bit 8 timer = 0, bit 9 counter = 0.
using Key = std::uint16_t;
inline constexpr std::size_t kKeys = 1024;

constexpr Key key_of(InputImage image, const State& state) {
    return static_cast<Key>(image | (state.timer == 0 ? 0x100U : 0U) | (state.counter == 0 ? 0x200U : 0U));
}

/// Is the condition of a term of the current step true?
inline bool is_true(TermView term, Key key) {
    const unsigned zero_missing =
        ((~static_cast<unsigned>(key) >> 1) & 0x80U) | ((~static_cast<unsigned>(key) >> 3) & 0x40U);
    const unsigned differing = (term[1] ^ static_cast<unsigned>(key)) & (term[2] | 0x80U) & 0xFFU;
    return (differing | (zero_missing & ~static_cast<unsigned>(term[0]))) == 0;
}

}  // namespace nplc::sequencer
