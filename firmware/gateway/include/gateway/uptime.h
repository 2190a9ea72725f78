#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::gateway {

/// Whole milliseconds since the first call, counted without 64-bit division.
class Uptime {
  public:
    void advance(base::Instant now) {
        if (!begun_) last_ = now;
        begun_ = true;
        constexpr base::Milliseconds kLongest{60'000};
        while (now - last_ > kLongest) {
            last_ += kLongest;
            milliseconds_ += static_cast<std::uint32_t>(kLongest.count());
        }
        const std::uint32_t passed = static_cast<std::uint32_t>((now - last_).count()) / 1000U;
        last_ += base::Milliseconds(passed);
        milliseconds_ += passed;
    }
    std::uint32_t milliseconds() const { return milliseconds_; }
    /// The time at which milliseconds() will have grown by `more`.
    base::Instant in(std::uint32_t more) const { return last_ + base::Milliseconds(more); }

  private:
    bool begun_ = false;
    base::Instant last_{};
    std::uint32_t milliseconds_ = 0;
};

}  // namespace nplc::gateway
