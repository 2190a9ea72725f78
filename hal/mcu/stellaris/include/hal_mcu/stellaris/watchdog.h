#pragma once

#include "base/time.h"
#include "ports/watchdog.h"

namespace nplc::hal_mcu::stellaris {

/// The chip's watchdog. After the watchdog timeout it interrupts (number kInterrupt), after twice the timeout
/// it resets. Once started only a reset stops it.
class Watchdog final : public ports::Watchdog {
  public:
    static constexpr unsigned kInterrupt = 18;

    /// `time`: 85 s at the most.
    void begin(base::Milliseconds time);
    /// Needs begin(); also feeds.
    void set_time(base::Milliseconds time);
    void feed() override;
};

}  // namespace nplc::hal_mcu::stellaris
