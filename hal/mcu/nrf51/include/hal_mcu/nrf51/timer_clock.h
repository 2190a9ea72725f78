#pragma once

#include <cstdint>

#include "ports/clock.h"

namespace nplc::hal_mcu::nrf51 {

/// Microseconds out of TIMER0, the one that has 32 bits; Nordic's Cortex-M0 has no SysTick. TIMER1 interrupts
/// every millisecond. For the loop only, and to be asked at least once an hour: the counter wraps after 71
/// minutes.
class TimerClock final : public ports::Clock {
  public:
    static constexpr unsigned kInterrupt = 9;

    void begin();
    base::Instant now() override;
    /// The counter, for who needs the time in the interrupt.
    static std::uint32_t on_interrupt();

  private:
    std::uint32_t last_ = 0;
    base::Instant time_{};
};

}  // namespace nplc::hal_mcu::nrf51
