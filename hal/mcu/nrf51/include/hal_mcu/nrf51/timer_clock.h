#pragma once

#include <cstdint>

#include "ports/clock.h"

namespace nplc::hal_mcu::nrf51 {

/// Microsecond clock by TIMER0, the only 32-bit timer; Nordic's Cortex-M0 has no SysTick. TIMER1 interrupts
/// every millisecond. For the main loop only, and to be read at least once an hour: the counter wraps after
/// 71 minutes.
class TimerClock final : public ports::Clock {
  public:
    static constexpr unsigned kInterrupt = 9;

    void begin();
    base::Instant now() override;
    /// Returns the counter, for use in the interrupt.
    static std::uint32_t on_interrupt();

  private:
    std::uint32_t last_ = 0;
    base::Instant time_{};
};

}  // namespace nplc::hal_mcu::nrf51
