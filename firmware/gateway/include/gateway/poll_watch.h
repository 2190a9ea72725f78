#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.h"

namespace nplc::gateway {

/// Measures how late polls are. A poll is due directly after the previous one, or at the time that expect()
/// names.
class PollWatch {
  public:
    /// An excess ends after so many milliseconds without a late poll.
    static constexpr std::uint32_t kInTime = 10'000;

    /// The board sleeps until `next`; not evaluated if that is more than a quarter of an hour away.
    void expect(base::Instant next, base::Instant now) {
        constexpr base::Microseconds kMost{900'000'000};
        due_ = next < now + kMost ? low_word(next < now ? now : next) : kNotDue;
    }

    /// Start of a poll. Returns its delay in us.
    std::uint32_t begin(base::Instant now) {
        constexpr std::uint32_t kBeforeIt = 0x8000'0000;
        const std::uint32_t due = due_;
        due_ = low_word(now);
        const std::uint32_t late = due_ - due;
        if (due == kNotDue || late >= kBeforeIt) return 0;
        if (worst_ < late) worst_ = late;
        return late;
    }
    /// Counts a poll that exceeded the limit. True for the first one of an excess; `uptime` in ms.
    bool begins_excess(std::uint32_t uptime) {
        const bool begins = late_ == 0 || uptime - late_at_ > kInTime;
        late_at_ = uptime;
        ++late_;
        return begins;
    }

    std::uint32_t worst() const { return worst_; }  ///< us, less than 36 minutes
    std::uint32_t late() const { return late_; }    ///< polls beyond the limit
    void clear_worst() { worst_ = 0; }

  private:
    static constexpr std::uint32_t kNotDue =
        0;  ///< marks "not due"; one instant in 71 minutes has the same value

    /// Differences below 2^31 us are correct across an overflow.
    static std::uint32_t low_word(base::Instant time) {
        return static_cast<std::uint32_t>(time.time_since_epoch().count());
    }

    std::uint32_t due_ = kNotDue;
    std::uint32_t worst_ = 0;
    std::uint32_t late_ = 0;
    std::uint32_t late_at_ = 0;
};

}  // namespace nplc::gateway
