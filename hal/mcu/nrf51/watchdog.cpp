#include "hal_mcu/nrf51/watchdog.h"

#include "hal_mcu/cortex_m/core.h"
#include "registers.h"

namespace nplc::hal_mcu::nrf51 {

/// A watchdog that was already running before this reset has the same settings and accepts no others.
void Watchdog::begin(base::Milliseconds time) {
    set_time(time);
    cortex_m::enable_interrupt(kInterrupt);
    begin_chip();
}

void Watchdog::begin_chip() {
    watchdog().CONFIG = kWatchdogRunsInSleep;
    watchdog().CRV = static_cast<std::uint32_t>(kWithoutTicks.count()) * kWatchdogHertz / 1000 - 1;
    watchdog().RREN = 1;
    watchdog().TASKS_START = 1;
    feed_chip();
}

void Watchdog::feed_chip() {
    watchdog().RR[0] = kWatchdogReload;
}

void Watchdog::set_time(base::Milliseconds time) {
    time_ = static_cast<std::uint32_t>(time.count()) * 1000;
    feed();
}

void Watchdog::on_tick(std::uint32_t now) {
    if (time_ == 0) return;
    if (fed_) fed_at_ = now;
    fed_ = false;
    if (now - fed_at_ > time_) return cortex_m::pend_interrupt(kInterrupt);
    feed_chip();
}

}  // namespace nplc::hal_mcu::nrf51
