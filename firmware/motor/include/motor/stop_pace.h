#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::motor {

/// How often a stop that is not confirmed is repeated: every 50 ms for 1 s, then every 500 ms.
class StopPace {
  public:
    /// A new stop was requested.
    void begin_anew() { count_ = 0; }
    /// A stop is sent: the pause until the next one.
    base::Microseconds next() {
        if (count_ == kQuickOnes) return kSlow;
        ++count_;
        return kQuick;
    }

  private:
    static constexpr base::Microseconds kQuick{50'000};
    static constexpr base::Microseconds kSlow{500'000};
    static constexpr std::uint8_t kQuickOnes = 20;

    std::uint8_t count_ = 0;
};

}  // namespace nplc::motor
