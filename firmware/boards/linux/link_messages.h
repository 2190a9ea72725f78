#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.h"

namespace nplc::boards {

/// Limits the journal's messages about a link that is lost repeatedly. The first kWhole losses of a minute
/// and their consequences are written in full; then only a count for each minute, until a minute has no more
/// than kWhole losses.
class LinkMessages {
  public:
    static constexpr unsigned kWhole = 3;
    static constexpr base::Microseconds kMinute{60'000'000};

    void lost(base::Instant now);
    void back() { is_up_ = true; }
    /// Whether messages about the link are written whole.
    bool writes_whole() const { return !is_limited_; }
    /// Once a minute, while they are not: "the link to the motor was lost 57 times in the last minute; ...".
    std::optional<std::string> count(base::Instant now);
    /// Latest time of the next count().
    base::Instant next() const { return minute_ ? *minute_ + kMinute : base::kNever; }

  private:
    std::optional<base::Instant> minute_;  ///< its begin, at a loss
    std::uint32_t losses_ = 0;             ///< in it
    bool is_limited_ = false;
    bool is_up_ = true;
};

}  // namespace nplc::boards
