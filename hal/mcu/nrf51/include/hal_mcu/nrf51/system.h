#pragma once

namespace nplc::hal_mcu::nrf51 {

/// Starts the 16 MHz crystal. The chip runs on its internal oscillator until the crystal is stable, about a
/// millisecond, and then switches over by itself.
void begin_crystal();

/// The watchdog has reset the chip since the last call.
bool take_watchdog_reset();
/// Reset by power or the reset pin, since take_watchdog_reset() was last called.
bool was_reset_from_outside();

}  // namespace nplc::hal_mcu::nrf51
