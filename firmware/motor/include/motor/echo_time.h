#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.h"

namespace nplc::motor {

/// How late a line brings echoes, beyond the characters' own time: the worst of late, follows a rise at once
/// and a fall slowly.
class EchoTime {
  public:
    static constexpr base::Microseconds kMost{40'000};  ///< a later line is not used
    static constexpr base::Microseconds kPatience{
        60'000};  ///< where nothing is known, or nothing may be wrong

    /// The echo of a message that was sent once. That of a repeated one tells nothing (Karn).
    void learn(base::Microseconds late) {
        const auto sample = static_cast<std::uint32_t>(std::max(late, base::Microseconds(0)).count());
        const std::uint32_t before = is_known_ ? late_ : pause_;
        late_ = wait_ = sample > before ? sample : before - (before - sample) / 16;
        is_known_ = true;
    }
    /// A message is repeated: it was lost, or the line has become later.
    void doubt() {
        wait_ = 2 * wait_ + 2'000;
        if (base::Microseconds(wait_) > kMost) forget();
    }
    /// Between two characters of a motor that never pauses.
    void pause(base::Microseconds time) {
        if (time <= kLeastPause) return;
        std::uint32_t& known = is_known_ ? late_ : pause_;
        known = std::max(known, static_cast<std::uint32_t>(std::min(time, kMost).count()));
    }
    void forget() {
        is_known_ = false;
        pause_ = 0;
    }

    bool is_known() const { return is_known_; }
    bool was_known() const { return is_known_ || late_ != 0; }
    bool is_too_late() const { return is_known_ && measured() > kMost; }
    /// The last that was known.
    base::Microseconds measured() const { return base::Microseconds(late_); }
    base::Microseconds at_most() const { return is_known_ ? measured() : kMost; }
    /// How long an echo is waited for where a repeat does no harm.
    base::Microseconds patience() const {
        return is_known_ ? base::Microseconds(std::max(wait_, late_)) : kPatience;
    }

  private:
    static constexpr base::Microseconds kLeastPause{8'000};  ///< more than lost characters explain

    std::uint32_t late_ = 0;
    std::uint32_t wait_ = 0;
    std::uint32_t pause_ = 0;
    bool is_known_ = false;
};

}  // namespace nplc::motor
