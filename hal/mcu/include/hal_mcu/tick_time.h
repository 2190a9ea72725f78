#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::hal_mcu {

/// The gateway's time line, from a millisecond counter that wraps after 49 days and the time within the
/// present millisecond. Must be called before each wrap.
class TickTime {
  public:
    base::Instant at(std::uint32_t milliseconds, std::uint32_t microseconds) {
        begun_ += base::Milliseconds(milliseconds - last_);
        last_ = milliseconds;
        const base::Instant now = begun_ + base::Microseconds(microseconds);
        if (now > latest_) latest_ = now;
        return latest_;
    }

  private:
    std::uint32_t last_ = 0;
    base::Instant begun_{};   ///< start of the present millisecond
    base::Instant latest_{};  ///< time never goes back
};

}  // namespace nplc::hal_mcu
