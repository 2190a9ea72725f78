#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "base/time.h"

/// Lines may bring characters late, as a USB adapter does. A microcontroller's own UART does not, and its
/// image is built without.
#ifndef NPLC_LATE_LINES
#define NPLC_LATE_LINES 1
#endif

namespace nplc::motor {

/// How late a line brings echoes, beyond the characters' own time: the worst of late, follows a rise at once
/// and a fall slowly.
class MeasuredEchoTime {
  public:
    static constexpr base::Microseconds kMost{40'000};  ///< a later line is not used
    static constexpr base::Microseconds kPatience{
        60'000};  ///< where nothing is known, or nothing may be wrong

    /// The echo of a message that was sent once. That of a repeated one tells nothing (Karn).
    void learn(base::Microseconds late);
    /// A message is repeated: it was lost, or the line has become later.
    void doubt();
    /// Between two characters of a motor that never pauses.
    void pause(base::Microseconds time);
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
    /// How long where a repeat would act twice, or is the last: `least`, and what is measured.
    base::Microseconds proof(base::Microseconds least, bool is_last) const {
        return is_known_ && !is_last ? least + measured() : std::max(least, kPatience);
    }

  private:
    bool is_known_ = false;
    std::uint32_t late_ = 0;
    std::uint32_t wait_ = 0;
    std::uint32_t pause_ = 0;
};

/// That of a line that holds nothing back.
class NoEchoTime {
  public:
    static constexpr base::Microseconds kMost{0};
    static constexpr base::Microseconds kPatience{0};

    void learn(base::Microseconds) {}
    void doubt() {}
    void pause(base::Microseconds) {}
    void forget() {}

    bool is_known() const { return true; }
    bool was_known() const { return false; }
    bool is_too_late() const { return false; }
    base::Microseconds measured() const { return {}; }
    base::Microseconds at_most() const { return {}; }
    base::Microseconds patience() const { return {}; }
    base::Microseconds proof(base::Microseconds least, bool) const { return least; }
};

using EchoTime = std::conditional_t<NPLC_LATE_LINES != 0, MeasuredEchoTime, NoEchoTime>;

}  // namespace nplc::motor
