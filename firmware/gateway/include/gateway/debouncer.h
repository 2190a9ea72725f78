#pragma once

#include <array>
#include <cstdint>

#include "base/time.h"

namespace nplc::gateway {

/// Six inputs. A new level counts once it has been steady for the debounce time; the first reading counts at
/// once.
class Debouncer {
  public:
    explicit Debouncer(base::Microseconds steady) : steady_(steady) {}

    std::uint8_t update(std::uint8_t raw, base::Instant now);
    void set_steady(base::Microseconds steady) { steady_ = steady; }
    std::uint8_t levels() const { return levels_; }
    /// The earliest time at which update() accepts a new level, if no input changes before.
    base::Instant next_update() const;

  private:
    base::Microseconds steady_;
    std::uint8_t levels_ = 0;
    std::uint8_t changing_ = 0;
    bool first_ = true;
    std::array<base::Instant, 6> since_{};
};

}  // namespace nplc::gateway
