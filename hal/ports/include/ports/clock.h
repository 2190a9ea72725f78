#pragma once

#include "base/time.h"

namespace nplc::ports {

/// Monotonic time. Only composition roots read it; all other code is passed the time.
class Clock {
  public:
    virtual base::Instant now() = 0;

  protected:
    ~Clock() = default;
};

}  // namespace nplc::ports
