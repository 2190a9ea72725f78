#include "hal_mcu/nrf51/system.h"

#include "registers.h"

namespace nplc::hal_mcu::nrf51 {

void begin_crystal() {
    power_clock().TASKS_HFCLKSTART = 1;
}

/// After power-up no bit is set.
bool was_reset_from_outside() {
    const std::uint32_t causes = power_clock().RESETREAS;
    return causes == 0 || (causes & kResetByPin) != 0;
}

/// The bits are kept until they are written.
bool take_watchdog_reset() {
    const bool was_watchdog = (power_clock().RESETREAS & kResetByWatchdog) != 0;
    power_clock().RESETREAS = 0xFFFF'FFFFU;
    return was_watchdog;
}

}  // namespace nplc::hal_mcu::nrf51
