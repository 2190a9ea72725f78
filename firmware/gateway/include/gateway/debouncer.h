#pragma once

#include <array>
#include <cstdint>

#include "base/time.h"

namespace nplc::gateway {

/// Six inputs, each taken over once it has been steady for the debounce time. The first reading is taken as
/// it is.
class Debouncer {
  public:
    explicit Debouncer(base::Microseconds steady) : steady_(steady) {}

    std::uint8_t update(std::uint8_t raw, base::Instant now);
    void set_steady(base::Microseconds steady) { steady_ = steady; }
    std::uint8_t levels() const { return levels_; }
    /// When update() takes over a level at the earliest, if none changes meanwhile.
    base::Instant next_update() const;

  private:
    base::Microseconds steady_;
    std::uint8_t levels_ = 0;
    std::uint8_t changing_ = 0;
    bool first_ = true;
    std::array<base::Instant, 6> since_{};
};

}  // namespace nplc::gateway
