#pragma once

#include <cstdint>

#include "ports/clock.h"

namespace nplc::hal_mcu::nrf51 {

/// Microseconds out of TIMER0, the one that has 32 bits; it interrupts every millisecond. Nordic's Cortex-M0
/// has no SysTick. For the loop only, and to be asked at least once an hour: the counter wraps after 71 minutes.
class TimerClock final : public ports::Clock {
  public:
    static constexpr unsigned kInterrupt = 8;

    void begin();
    base::Instant now() override;
    static void on_interrupt();

  private:
    std::uint32_t last_ = 0;
    base::Instant time_{};
};

}  // namespace nplc::hal_mcu::nrf51
