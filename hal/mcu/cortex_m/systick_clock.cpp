#include "hal_mcu/cortex_m/systick_clock.h"

#include "registers.h"

namespace nplc::hal_mcu::cortex_m {

void SysTickClock::begin(std::uint32_t hertz) {
    per_microsecond_ = hertz / 1'000'000U;
    per_millisecond_ = hertz / 1'000U;
    systick().RVR = per_millisecond_ - 1;
    systick().CVR = 0;
    systick().CSR = kCsrEnable | kCsrInterrupt | kCsrOfCore;
}

/// Reads again if the interrupt came in between.
base::Instant SysTickClock::now() {
    std::uint32_t milliseconds = 0;
    std::uint32_t left = 0;
    do {
        milliseconds = milliseconds_.load();
        left = systick().CVR;
    } while (milliseconds != milliseconds_.load());
    return time_.at(milliseconds, (per_millisecond_ - 1 - left) / per_microsecond_);
}

}  // namespace nplc::hal_mcu::cortex_m
