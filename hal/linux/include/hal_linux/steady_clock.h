#pragma once

#include <cstdint>

#include "ports/clock.h"

namespace nplc::hal_linux {

/// CLOCK_MONOTONIC: never set, and stands still while the machine sleeps.
class SteadyClock final : public ports::Clock {
  public:
    base::Instant now() override;
};

/// The calendar, in ms since 1970; it may be set, and jumps then.
std::uint64_t calendar_milliseconds();

}  // namespace nplc::hal_linux
