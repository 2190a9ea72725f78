#pragma once

#include <cstdint>

#include "ports/clock.h"

namespace nplc::hal_linux {

/// CLOCK_MONOTONIC: never set, and stopped while the machine sleeps.
class SteadyClock final : public ports::Clock {
  public:
    base::Instant now() override;
};

/// Wall-clock time, ms since 1970; jumps when it is set.
std::uint64_t calendar_milliseconds();

}  // namespace nplc::hal_linux
