#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "base/time.h"
#include "motor/motor.h"

namespace nplc::motor {

/// Estimate of the line's echo delay beyond the characters' own time: follows an increase at once and a
/// decrease slowly.
class MeasuredEchoTime {
  public:
    static constexpr base::Microseconds kMost = kLongestEcho;
    static constexpr base::Microseconds kPatience{
        60'000};  ///< without an estimate, or where an early repeat does harm

    /// The echo of a message that was sent once. That of a repeated message is ambiguous and not used (Karn).
    void learn(base::Microseconds late);
    /// A message is repeated: it was lost, or the delay has increased.
    void doubt();
    /// Pause between two status characters of a motor that sends without pauses.
    void pause(base::Microseconds time);
    void forget() {
        is_known_ = false;
        pause_ = 0;
    }

    bool is_known() const { return is_known_; }
    bool was_known() const { return is_known_ || late_ != 0; }
    bool is_too_late() const { return is_known_ && measured() > kMost; }
    /// The last known estimate.
    base::Microseconds measured() const { return base::Microseconds(late_); }
    /// By that: no line that is up has been.
    bool was_too_late() const { return measured() > kMost; }
    base::Microseconds at_most() const { return is_known_ ? measured() : kMost; }
    /// Echo timeout where a repeat does no harm.
    base::Microseconds patience() const {
        return is_known_ ? base::Microseconds(std::max(wait_, late_)) : kPatience;
    }
    /// Echo timeout where a repeat would act twice or is the last: `least` plus the estimate.
    base::Microseconds proof(base::Microseconds least, bool is_last) const {
        return is_known_ && !is_last ? least + measured() : std::max(least, kPatience);
    }

  private:
    bool is_known_ = false;
    std::uint32_t late_ = 0;
    std::uint32_t wait_ = 0;
    std::uint32_t pause_ = 0;
};

/// For a line without delay.
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
    bool was_too_late() const { return false; }
    base::Microseconds measured() const { return {}; }
    base::Microseconds at_most() const { return {}; }
    base::Microseconds patience() const { return {}; }
    base::Microseconds proof(base::Microseconds least, bool) const { return least; }
};

using EchoTime = std::conditional_t<kLateLines, MeasuredEchoTime, NoEchoTime>;

}  // namespace nplc::motor
