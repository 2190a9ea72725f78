#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.h"
#include "ports/watchdog.h"

namespace nplc::hal_mcu::nrf51 {

/// Bites twice. After the time without feeding, counted by the clock's ticks, interrupt kInterrupt comes; when
/// no ticks come any more the chip's own watchdog, whose time cannot be changed once it runs, resets the chip
/// after kWithoutTicks. Once begun nothing but a reset ends it.
class Watchdog final : public ports::Watchdog {
  public:
    static constexpr unsigned kInterrupt = 20;  ///< the first that no device of the chip has
    static constexpr base::Milliseconds kWithoutTicks{500};

    void begin(base::Milliseconds time);
    /// Only after begin(); feeds.
    void set_time(base::Milliseconds time);
    void feed() override { left_ = time_; }
    /// Every millisecond, from the clock's interrupt.
    void on_tick();

  private:
    static constexpr std::uint32_t kNotBegun = 0xFFFF'FFFFU;

    std::uint32_t time_ = kNotBegun;  ///< ticks
    std::atomic<std::uint32_t> left_{kNotBegun};
};

}  // namespace nplc::hal_mcu::nrf51
