#pragma once

#include <cstdint>

#include "hal_mcu/crash_record.h"

namespace nplc::hal_mcu::cortex_m {

/// Cause for an unhandled exception, with the core's numbers: the chip's interrupts from 16 on, of which
/// `watchdog` is the watchdog's.
constexpr EndCause end_cause(std::uint32_t exception, unsigned watchdog) {
    constexpr std::uint32_t kFirstInterrupt = 16;
    switch (exception) {
        case 3:
            return EndCause::hard_fault;
        case 4:
            return EndCause::memory_fault;
        case 5:
            return EndCause::bus_fault;
        case 6:
            return EndCause::usage_fault;
        case 11:
            return EndCause::pure_call;
        default:
            return exception == kFirstInterrupt + watchdog ? EndCause::watchdog : EndCause::stray_interrupt;
    }
}

}  // namespace nplc::hal_mcu::cortex_m
