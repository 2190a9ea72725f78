#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "registers/midi.h"

/// A sequence's orders, which are those of a JVL motor (001 §5.2.1.4, registers by their numbers on
/// MAC50-141), on a MIDI drive: which of them it supports, and the conversion of JVL's units to MIDI's.
/// 32-bit integers only, no tables of values: suitable for a small microcontroller. The whole translation:
/// firmware/motor/MIDI.md.
namespace nplc::registers::midi {

/// Why a MIDI drive cannot execute an order.
enum class Limitation : std::uint8_t {
    none,             ///< supported
    load_factor,      ///< L registers, KVOUT
    function_error,   ///< P_FNC, and motion by it: 04h, 08h, 09h, 16h
    homing,           ///< 10h, HOME_MODE and its registers
    mode,             ///< MODE_REG other than 0, 1, 2
    gear,             ///< pulse input
    analogue,         ///< analogue input
    actual_position,  ///< P_IST other than 0
    no_register,      ///< any other register
    too_far,          ///< position beyond -1073741824..1073741823 increments
    too_slow,         ///< a period over 65535
    no_speed,         ///< a move at the drive's own speed, which is 0 (period 0)
    no_acceleration,  ///< A 0, which on MIDI would mean no limit
    too_soft,         ///< a ramp over 255
    too_much_torque,  ///< T over 1023
    window,           ///< INPOSWIN 0, or a tolerance over 255 increments
};

/// Text for the user: reason and remedy, without a full stop.
std::string_view text_of(Limitation limitation);

/// For a FastMAC command, bits 6..0.
Limitation limitation_of_command(std::uint8_t command);
/// For a register write, by its own value only. Limits that depend on several registers (a ramp, the halves
/// of a position) are checked when the order is executed.
Limitation limitation_of_write(Model model, std::uint8_t reg, bool longword, std::uint32_t value);
/// For motion with both values, if both are known. V_SOLL 0 is always supported: standstill.
Limitation limitation_of_profile(Model model, std::int16_t v_soll, std::uint16_t a_soll);

/// 4096 counts are 2000 increments on MAC23 and 10000 on MAC34; to the nearest, a half upwards. Empty beyond
/// kMinPosition..kMaxPosition.
std::optional<std::int32_t> increments_of_counts(Model model, std::int32_t counts);
/// To the nearest, a half upwards; wraps if 32 bits are exceeded, as P_IST does. On MAC34 it exactly reverses
/// increments_of_counts(); on MAC23, where an increment is 2.048 counts, within 1 count.
std::int32_t counts_of_increments(Model model, std::int32_t increments);

/// V_SOLL's magnitude, in 1/16 count/sample (0.4768 rpm), as VVVV to the nearest, a half upwards. 0 for 0,
/// which is a stop; empty if the period would exceed 65535 (|V_SOLL| below 2 on MAC34 and below 8 on MAC23).
std::optional<std::uint16_t> period_of_v_soll(Model model, std::int16_t v_soll);
/// The reverse, to the nearest and at most 32767; 0 for 0.
std::int16_t v_soll_of_period(Model model, std::uint16_t period);

/// The ramp that accelerates to a period's speed with at most A_SOLL (1/16 count/sample^2): v^2 / (2 a x 120)
/// rounded up, from the period itself. Empty for A_SOLL 0, for period 0 and over 255.
std::optional<std::uint8_t> ramp_of_a_soll(Model model, std::uint16_t a_soll, std::uint16_t period);

/// T_SOLL 0..1023 as 0..`imax`, rounded down; empty above.
std::optional<std::uint8_t> torque_of_t_soll(std::uint16_t t_soll, std::uint8_t imax);

/// IN_POS within fewer counts than INPOSWIN as TT, which is inclusive: the largest number of increments below
/// the window, so the scaled window rounded up, minus 1. Empty for 0 and over 255 (INPOSWIN above 104 on
/// MAC34 and 524 on MAC23).
std::optional<std::uint8_t> tolerance_of_window(Model model, std::uint16_t window);

}  // namespace nplc::registers::midi
