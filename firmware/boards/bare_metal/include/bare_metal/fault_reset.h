#pragma once

#include <cstdint>

#include "hal_mcu/crash_record.h"
#include "hal_mcu/run_marker.h"

/// How the firmware resets the chip after a fault, and what its next start knows of it.
namespace nplc::bare_metal {

/// The outputs' safe values as they were before the reset; 0 after power-up.
std::uint8_t safe_outputs();
void keep_safe_outputs(std::uint8_t levels);
hal_mcu::CrashRecord& crash_record();
/// Set while the firmware runs. A board clears it before run() if its chip says that somebody pressed reset.
hal_mcu::RunMarker& run_marker();

/// Output pins to their safe values, the reason kept for the next start, reset.
[[noreturn]] void reset_after_fault(hal_mcu::EndCause cause, std::uint32_t code_address);

/// After an exception that is nobody's; `watchdog`: the number of the interrupt that is the watchdog's.
[[noreturn]] void reset_after_exception(std::uint32_t exception, unsigned watchdog,
                                        std::uint32_t code_address);

/// The board's, for when nothing works any more.
void write_outputs(std::uint8_t levels);

}  // namespace nplc::bare_metal
