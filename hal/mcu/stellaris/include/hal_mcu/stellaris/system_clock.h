#pragma once

#include <cstdint>

namespace nplc::hal_mcu::stellaris {

inline constexpr std::uint32_t kHertz = 50'000'000;

/// 50 MHz from an 8 MHz crystal by the PLL, and the clocks of the ports. False if the PLL does not lock.
bool begin_clock();

/// The watchdog has reset the chip since the last call.
bool take_watchdog_reset();
/// Reset by power or the reset pin, since take_watchdog_reset() was last called.
bool was_reset_from_outside();

}  // namespace nplc::hal_mcu::stellaris
