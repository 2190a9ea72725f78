#include "hal_mcu/stellaris/watchdog.h"

#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

WatchdogRegisters& timer() {
    return block<WatchdogRegisters>(0x4000'0000U);
}

}  // namespace

void Watchdog::begin(base::Milliseconds time) {
    set_time(time);
    timer().LOCK = kWatchdogKey;
    timer().CTL = kWatchdogInterrupt | kWatchdogResets;
    timer().LOCK = 0;
    cortex_m::enable_interrupt(kInterrupt);
}

void Watchdog::set_time(base::Milliseconds time) {
    timer().LOCK = kWatchdogKey;
    timer().LOAD = static_cast<std::uint32_t>(time.count()) * (kHertz / 1000);
    timer().LOCK = 0;
}

void Watchdog::feed() {
    timer().LOCK = kWatchdogKey;
    timer().ICR = 0;
    timer().LOCK = 0;
}

}  // namespace nplc::hal_mcu::stellaris
