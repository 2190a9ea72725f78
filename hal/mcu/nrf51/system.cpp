#include "hal_mcu/nrf51/system.h"

#include "registers.h"

namespace nplc::hal_mcu::nrf51 {

void begin_crystal() {
    power_clock().TASKS_HFCLKSTART = 1;
}

/// Its bits stay until they are written.
bool take_watchdog_reset() {
    const bool was_watchdog = (power_clock().RESETREAS & kResetByWatchdog) != 0;
    power_clock().RESETREAS = kResetByWatchdog;
    return was_watchdog;
}

}  // namespace nplc::hal_mcu::nrf51
