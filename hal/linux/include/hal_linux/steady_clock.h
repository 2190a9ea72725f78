#pragma once

#include "ports/clock.h"

namespace nplc::hal_linux {

/// CLOCK_MONOTONIC: never set, and stands still while the machine sleeps.
class SteadyClock final : public ports::Clock {
  public:
    base::Instant now() override;
};

}  // namespace nplc::hal_linux
