#pragma once

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
/// and a fall slowly. In us, of 32 bits: what is longer than kMost is no line that is used.
class MeasuredEchoTime {
  public:
    static constexpr std::uint32_t kMost = 40'000;      ///< a later line is not used
    static constexpr std::uint32_t kPatience = 60'000;  ///< where nothing is known, or nothing may be wrong

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
    bool is_too_late() const { return is_known_ && late_ > kMost; }
    /// The last that was known.
    base::Microseconds measured() const { return base::Microseconds(late_); }
    base::Microseconds at_most() const { return base::Microseconds(is_known_ ? late_ : kMost); }
    /// How long an echo is waited for where a repeat does no harm.
    std::uint32_t patience() const {
        if (!is_known_) return kPatience;
        return wait_ > late_ ? wait_ : late_;
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
    static constexpr std::uint32_t kMost = 0;
    static constexpr std::uint32_t kPatience = 0;

    void learn(base::Microseconds) {}
    void doubt() {}
    void pause(base::Microseconds) {}
    void forget() {}

    bool is_known() const { return true; }
    bool was_known() const { return false; }
    bool is_too_late() const { return false; }
    base::Microseconds measured() const { return {}; }
    base::Microseconds at_most() const { return {}; }
    std::uint32_t patience() const { return 0; }
};

using EchoTime = std::conditional_t<NPLC_LATE_LINES != 0, MeasuredEchoTime, NoEchoTime>;

}  // namespace nplc::motor
