#pragma once

#include <atomic>
#include <cstdint>

#include "hal_mcu/tick_time.h"
#include "ports/clock.h"

namespace nplc::hal_mcu::cortex_m {

/// Microsecond clock by SysTick, which interrupts every millisecond. For the main loop only, not for
/// interrupts.
class SysTickClock final : public ports::Clock {
  public:
    /// `hertz`: core clock, whole megahertz.
    void begin(std::uint32_t hertz);
    base::Instant now() override;

    void on_interrupt() { milliseconds_.store(milliseconds_.load(std::memory_order_relaxed) + 1); }

  private:
    std::atomic<std::uint32_t> milliseconds_{0};
    std::uint32_t per_microsecond_ = 1;
    std::uint32_t per_millisecond_ = 1000;
    TickTime time_;
};

}  // namespace nplc::hal_mcu::cortex_m
