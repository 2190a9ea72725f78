#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// The bytes of a table's terms, field by field as 001 §6.1.5 to §6.1.7 name them.
namespace nplc::verify {

/// What a motor may be doing by what was ordered, as numbers: 0 INIT, 1 to a place, 2 runs, 3 to a place for
/// an unknown time, 4 in its place, 5 there with V_SOLL 0, 6 on its way with V_SOLL 0, 7 in velocity mode
/// with V_SOLL 0, 8 homing, 9 homing for an unknown time, 10 in a torque or test mode.
inline constexpr std::size_t kManualMotions = 11;
using ManualMotions = std::array<std::uint8_t, kManualMotions>;  ///< by what it was doing: what it does then

inline constexpr bool is_manual_moving(std::uint8_t motion) {
    return motion == 1 || motion == 2 || motion == 3 || motion == 8 || motion == 9 || motion == 10;
}
/// Moves whose time may be known.
inline constexpr bool is_manual_timed(std::uint8_t motion) {
    return motion == 1 || motion == 8;
}

/// What a term orders of the motor, as far as `moving` goes: a row of kManualEffects.
enum class ManualMotion : std::uint8_t {
    keeps,
    init,
    run,
    place,
    hold,
    hold_v,
    home,
    drive,
    stop,
    speed,
    target
};
inline constexpr std::array<ManualMotions, 11> kManualEffects = {{
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10},            // keeps
    {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},             // init
    {2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2},             // run
    {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},             // place
    {3, 1, 3, 3, 4, 5, 6, 6, 3, 3, 3},             // hold: position mode, the target stays
    {3, 1, 3, 3, 4, 4, 3, 3, 3, 3, 3},             // hold_v: and V_SOLL is something
    {8, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8},             // home
    {10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10},  // drive
    {0, 6, 7, 6, 5, 5, 6, 7, 8, 9, 10},            // stop
    {0, 1, 2, 3, 4, 4, 3, 2, 8, 9, 10},            // speed
    {0, 3, 2, 3, 3, 6, 6, 7, 8, 9, 10},            // target
}};
constexpr const ManualMotions& effect_of(ManualMotion motion) {
    return kManualEffects[static_cast<std::size_t>(motion)];
}

/// Bits of P_SOLL, P_IST and P_FNC, which a term may clear: all three in one scan, with no other order to the
/// motion between, move nothing.
inline constexpr unsigned kAllCleared = 7;

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
    std::uint8_t clears = 0;  ///< bits of kAllCleared
};

/// A FastMAC command (001 §5.2.1.4); bit 7 says that there is none (§6.1.7).
inline ManualMotion motion_of_command(unsigned byte) {
    if ((byte & 0x80U) != 0) return ManualMotion::keeps;
    const unsigned rest = byte & 0x1FU;
    switch (byte >> 5U) {
        case 0:  // INIT, whatever it selects
            return ManualMotion::init;
        case 1:  // velocity mode
            return ManualMotion::run;
        case 2:  // position mode: P1 to P8 are new targets, then V1 to V8
            return rest < 8 ? ManualMotion::place : rest < 16 ? ManualMotion::hold_v : ManualMotion::hold;
        default:
            break;
    }
    switch (rest) {
        case 0x02:  // P_SOLL = 0
        case 0x04:  // P_FNC = 0
            return ManualMotion::target;
        case 0x05:  // V_SOLL = 0
            return ManualMotion::stop;
        case 0x10:
            return ManualMotion::home;
        default:
            break;
    }
    const bool by_p7_p8 = rest == 0x08 || rest == 0x09 || rest == 0x11 || rest == 0x12;
    const bool by_set = rest >= 0x0C && rest <= 0x0F;
    return by_p7_p8 || by_set ? ManualMotion::place : ManualMotion::keeps;
}

inline std::uint8_t clears_of_command(unsigned byte) {
    constexpr unsigned kCommandMode = 0x60;
    const unsigned rest = byte - kCommandMode;
    return rest >= 2 && rest <= 4 ? static_cast<std::uint8_t>(1U << (rest - 2)) : std::uint8_t{0};
}

/// A register value (001 §3.2): 2 MODE_REG, 3 P_SOLL, 5 V_SOLL, 8 P_FNC, 43 P_REG_P, 44 V_REG_P.
inline ManualMotion motion_of_write(unsigned reg, std::uint32_t value) {
    if (reg == 5) return value == 0 ? ManualMotion::stop : ManualMotion::speed;
    if (reg == 44) return ManualMotion::speed;
    if (reg == 3 || reg == 8 || reg == 43) return ManualMotion::target;
    if (reg != 2 || value == 15 || value > 24) return ManualMotion::keeps;
    if (value == 0 || value == 11) return ManualMotion::init;
    if (value == 2) return ManualMotion::place;
    if (value >= 12 && value <= 14) return ManualMotion::home;
    const bool by_torque = value == 4 || (value >= 7 && value <= 10) || value == 22 || value == 23;
    return by_torque ? ManualMotion::drive : ManualMotion::run;
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
        term.clears = term.is_flexmac ? std::uint8_t{0} : clears_of_command(b[4]);
    }
    return terms;
}

}  // namespace nplc::verify
