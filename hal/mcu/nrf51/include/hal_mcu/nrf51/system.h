#pragma once

namespace nplc::hal_mcu::nrf51 {

/// Starts the 16 MHz crystal. The chip runs on its own oscillator until the crystal swings, about a
/// millisecond, and changes over by itself.
void begin_crystal();

/// The chip says that its watchdog has reset it since this was last asked.
bool take_watchdog_reset();
/// By power, or by the reset pin, since take_watchdog_reset() was last called.
bool was_reset_from_outside();

}  // namespace nplc::hal_mcu::nrf51
