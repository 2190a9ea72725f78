#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/time.h"

namespace nplc::mqtt {

/// When to connect to a broker again, and what is told of it: each reason once. Connections that last shorter
/// than kSteady, kShortOnes of them one after the other, are told once and made ever more seldom: most often
/// another client has the same name, and each throws the other one out. A broker that is not there or silent
/// is asked again at least every kLongestAway, one that refuses or throws out ever more seldom.
class Attempts {
  public:
    static constexpr base::Milliseconds kFirstPause{1'000};
    static constexpr base::Milliseconds kLongestAway{4'000};
    static constexpr base::Milliseconds kLongestPause{30'000};
    static constexpr base::Milliseconds kSteady{60'000};
    static constexpr int kShortOnes = 3;

    explicit Attempts(std::string name) : name_(std::move(name)) {}

    bool is_due(base::Instant now) const { return now >= next_; }
    const std::string& name() const { return name_; }

    /// A connection has been made. True: it is to be told.
    bool made(base::Instant now) {
        made_ = now;
        if (short_ones_ >= kShortOnes) return false;
        if (short_ones_ == 0) pause_ = kFirstPause;
        told_.clear();
        return true;
    }
    /// To be called while it is there. True: it is to be told that it lasts, after several that did not.
    bool lasts(base::Instant now) {
        if (!made_ || now - *made_ <= kSteady) return false;
        const bool is_news = short_ones_ >= kShortOnes;
        if (is_news) told_.clear();
        short_ones_ = 0;
        pause_ = kFirstPause;
        return is_news;
    }
    /// It is lost, or was not made, for the reason `text`; `is_refused`: the broker answered, and did not
    /// take us. What is to be told; empty: nothing.
    std::string lost(base::Instant now, std::string text, bool is_refused = false) {
        if (made_ && now - *made_ <= kSteady) ++short_ones_;
        made_.reset();
        const bool is_away = !is_refused && short_ones_ < kShortOnes;
        const base::Milliseconds longest = is_away ? kLongestAway : kLongestPause;
        next_ = now + std::min(pause_, longest);
        pause_ = std::min(pause_ * 2, longest);
        if (short_ones_ >= kShortOnes)
            text += fmt::format(
                "; again and again: is there another client {}? `group` and `node` must be its own", name_);
        if (text == told_) return {};
        told_ = text;
        return text;
    }
    /// It was ended in order.
    void left(base::Instant now) {
        made_.reset();
        next_ = now + kFirstPause;
    }

  private:
    std::string name_;  ///< of the client
    base::Instant next_{};
    base::Milliseconds pause_ = kFirstPause;
    std::optional<base::Instant> made_{};
    int short_ones_ = 0;
    std::string told_{};
};

}  // namespace nplc::mqtt
