#pragma once

#include "registers/midi.h"

/// Conversion between physical units and the values in a MIDI module's commands and replies, in integers
/// only. Inexact values are rounded as described at each function; values out of range are empty.
namespace nplc::registers::midi {

inline constexpr std::uint32_t kTicksPerSecond = 8'000'000;  ///< periods count 0.125 us
inline constexpr std::uint32_t kTicksPerLongPeriod = 1'600;  ///< 200 us (000 §VI 0Eh)
inline constexpr std::uint32_t kRampIncrements = 120;        ///< a unit of RAMP (000 §VI 0Fh)

/// rpm x period: 240000 on MAC23, 48000 on MAC34 (000 §VI 0Dh).
std::uint32_t rpm_times_period(Model model);

/// Speed to VV of UNSTALL, the next slower one; empty beyond 1..255, that is 5000 to 20 increments a second.
std::optional<std::uint8_t> unstall_of_speed(std::uint32_t increments_per_second);

/// The ramp that accelerates to `speed` with at most `acceleration`: v^2 / (2 a x 120) rounded up. Empty if
/// more than 255 would be needed, or for acceleration 0. No division. Increments a second, and a second^2.
std::optional<std::uint8_t> ramp_of(std::uint32_t speed, std::uint32_t acceleration);

/// GET_MEASURES's temperature in thousandths of a degree, exactly (000 §VI 27h; valid from 0 to 100 °C).
std::int32_t temperature_of(Model model, std::uint8_t measure);
/// The nearest measure, limited to 0..255.
std::uint8_t measure_of_temperature(Model model, std::int32_t thousandths);
/// GET_MEASURES's supply in mV, to the nearest.
std::int32_t supply_of(Model model, std::uint8_t measure);
std::uint8_t measure_of_supply(Model model, std::int32_t millivolts);

}  // namespace nplc::registers::midi
