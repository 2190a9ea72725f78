#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.h"
#include "ports/watchdog.h"

namespace nplc::hal_mcu::nrf51 {

/// Two stages. The watchdog timeout, checked with each clock tick, triggers interrupt kInterrupt; if there
/// are no ticks any more, the chip's own watchdog, whose timeout cannot be changed once it runs, resets the
/// chip after kWithoutTicks. Once started only a reset stops it.
class Watchdog final : public ports::Watchdog {
  public:
    static constexpr unsigned kInterrupt = 20;  ///< the first one that no device of the chip uses
    static constexpr base::Milliseconds kWithoutTicks{500};

    /// `time`: an hour at the most.
    void begin(base::Milliseconds time);
    /// Needs begin(); also feeds.
    void set_time(base::Milliseconds time);
    void feed() override { fed_ = true; }
    /// Starts or feeds only the chip's own watchdog: for a loader, after which begin() finds it running.
    static void begin_chip();
    static void feed_chip();
    /// To be called by the clock's interrupt; `now` in microseconds, may wrap.
    void on_tick(std::uint32_t now);

  private:
    std::atomic<std::uint32_t> time_{0};  ///< microseconds; 0 before begin()
    std::atomic<bool> fed_{false};
    std::uint32_t fed_at_ = 0;
};

}  // namespace nplc::hal_mcu::nrf51
