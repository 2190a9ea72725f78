#pragma once

#include "base/time.h"

namespace nplc::ports {

/// Monotonic time. Read by composition roots only; everything else is given the time.
class Clock {
  public:
    virtual base::Instant now() = 0;

  protected:
    ~Clock() = default;
};

}  // namespace nplc::ports
