#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// The bytes of a table's terms, field by field as 001 §6.1.5 to §6.1.7 name them.
namespace nplc::verify {

/// The effect of a term's command on the motor, as far as `moving` depends on it.
enum class ManualMotion : std::uint8_t {
    stands,
    to_place,
    endless,
    keeps,
};

struct ManualTerm {
    std::uint8_t state = 0;
    bool timer_must_be_zero = false;
    bool counter_must_be_zero = false;
    std::uint8_t input = 0;
    std::uint8_t compared = 0;  ///< bits of HW_INP: CARE's, and ERROR always
    bool is_flexmac = false;    ///< the rest is of FastMAC format
    std::uint8_t next_state = 0;
    bool names_next = false;
    bool word_is_counter = false;
    std::uint8_t output_byte = 0;
    std::uint16_t word = 0;
    ManualMotion motion = ManualMotion::keeps;
};

/// A FastMAC command (001 §5.2.1.4); bit 7 says that there is none (§6.1.7).
inline ManualMotion motion_of_command(unsigned byte) {
    if ((byte & 0x80U) != 0) return ManualMotion::keeps;
    const unsigned rest = byte & 0x1FU;
    switch (byte >> 5U) {
        case 0:  // INIT, whatever it selects
            return ManualMotion::stands;
        case 1:  // velocity mode
            return ManualMotion::endless;
        case 2:  // position mode: P1 to P8 are new targets
            return rest < 8 ? ManualMotion::to_place : ManualMotion::keeps;
        default:
            break;
    }
    if (rest == 0x05) return ManualMotion::stands;  // V_SOLL = 0
    const bool by_p7_p8 = rest == 0x08 || rest == 0x09 || rest == 0x11 || rest == 0x12;
    const bool by_set = rest >= 0x0C && rest <= 0x0F;
    return by_p7_p8 || by_set || rest == 0x10 ? ManualMotion::to_place : ManualMotion::keeps;
}

/// A register value: MODE_REG is register 2, V_SOLL register 5 (001 §3.2).
inline ManualMotion motion_of_write(unsigned reg, std::uint32_t value) {
    if (reg == 5) return value == 0 ? ManualMotion::stands : ManualMotion::keeps;
    if (reg != 2) return ManualMotion::keeps;
    if (value == 0) return ManualMotion::stands;
    const bool by_velocity = value == 1 || value == 3 || (value >= 17 && value <= 21) || value == 24;
    if (by_velocity) return ManualMotion::endless;
    return value == 2 || (value >= 12 && value <= 14) ? ManualMotion::to_place : ManualMotion::keeps;
}

/// Up to the term whose STATE is 63.
inline std::vector<ManualTerm> manual_terms(std::span<const std::uint8_t> table) {
    std::vector<ManualTerm> terms;
    for (std::size_t at = 0; at + 8 <= table.size() && (table[at] & 0x3FU) != 0x3F; at += 8) {
        const auto b = table.subspan(at, 8);
        ManualTerm& term = terms.emplace_back();
        term.state = b[0] & 0x3F;
        term.counter_must_be_zero = (b[0] & 0x40U) == 0;
        term.timer_must_be_zero = (b[0] & 0x80U) == 0;
        term.compared = static_cast<std::uint8_t>((b[2] & 0x7FU) | 0x80U);
        term.input = b[1] & term.compared;
        term.is_flexmac = (b[2] & 0x80U) != 0;
        term.next_state = b[3] & 0x3F;
        term.names_next = term.next_state != 0x3E;
        term.word_is_counter = (b[3] & 0x40U) != 0;
        term.output_byte = b[5];
        term.word = static_cast<std::uint16_t>(b[6] | (b[7] << 8U));
        const std::uint32_t low = b[4] | (unsigned{b[5]} << 8U);
        const std::uint32_t high = (b[3] & 0x80U) != 0 ? b[6] | (unsigned{b[7]} << 8U) : 0U;
        term.motion =
            term.is_flexmac ? motion_of_write(b[3] & 0x7FU, low | high << 16U) : motion_of_command(b[4]);
    }
    return terms;
}

}  // namespace nplc::verify
