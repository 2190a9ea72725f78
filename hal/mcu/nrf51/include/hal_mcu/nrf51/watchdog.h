#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.h"
#include "ports/watchdog.h"

namespace nplc::hal_mcu::nrf51 {

/// Bites twice. After the time without feeding, looked at with each of the clock's ticks, interrupt
/// kInterrupt comes; when no ticks come any more the chip's own watchdog, whose time cannot be changed once
/// it runs, resets the chip after kWithoutTicks. Once begun nothing but a reset ends it.
class Watchdog final : public ports::Watchdog {
  public:
    static constexpr unsigned kInterrupt = 20;  ///< the first that no device of the chip has
    static constexpr base::Milliseconds kWithoutTicks{500};

    /// `time`: an hour at the most.
    void begin(base::Milliseconds time);
    /// Only after begin(); feeds.
    void set_time(base::Milliseconds time);
    void feed() override { fed_ = true; }
    /// The chip's own alone, and its food: for a loader, after which begin() finds it running.
    static void begin_chip();
    static void feed_chip();
    /// From the clock's interrupt; `now` in microseconds, may wrap.
    void on_tick(std::uint32_t now);

  private:
    std::atomic<std::uint32_t> time_{0};  ///< microseconds; 0 until it is begun
    std::atomic<bool> fed_{false};
    std::uint32_t fed_at_ = 0;
};

}  // namespace nplc::hal_mcu::nrf51
