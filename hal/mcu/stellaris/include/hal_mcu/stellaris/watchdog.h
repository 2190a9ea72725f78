#pragma once

#include "base/time.h"
#include "ports/watchdog.h"

namespace nplc::hal_mcu::stellaris {

/// The chip's watchdog. After the time without feeding it interrupts (number kInterrupt), after twice the
/// time it resets. Once begun nothing but a reset ends it.
class Watchdog final : public ports::Watchdog {
  public:
    static constexpr unsigned kInterrupt = 18;

    /// `time`: 85 s at the most.
    void begin(base::Milliseconds time);
    /// Only after begin(); feeds.
    void set_time(base::Milliseconds time);
    void feed() override;
};

}  // namespace nplc::hal_mcu::stellaris
