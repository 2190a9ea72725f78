#pragma once

#include <cstdint>

#include "hal_mcu/crash_record.h"
#include "hal_mcu/run_marker.h"

/// Chip reset after a fault, and the state that is kept for the next start.
namespace nplc::bare_metal {

/// The outputs' safe values as they were before the reset; 0 after power-up.
std::uint8_t safe_outputs();
void keep_safe_outputs(std::uint8_t levels);
hal_mcu::CrashRecord& crash_record();
/// Set while the firmware runs. A board clears it before run() if the chip reports a reset by its pin.
hal_mcu::RunMarker& run_marker();

/// Sets the output pins to their safe values, stores the cause for the next start, resets.
[[noreturn]] void reset_after_fault(hal_mcu::EndCause cause, std::uint32_t code_address);

/// For an unhandled exception; `watchdog`: the number of the watchdog's interrupt.
[[noreturn]] void reset_after_exception(std::uint32_t exception, unsigned watchdog,
                                        std::uint32_t code_address);

/// Provided by the board; must work after a fault, without the firmware's other parts.
void write_outputs(std::uint8_t levels);

}  // namespace nplc::bare_metal
