#pragma once

#include <algorithm>
#include <cstdint>

namespace nplc::protocol {

/// Distinguishes two MIDI modules at one address from late answers. A module answers each request once, so an
/// answer without a request is another module's. A damaged bit, a frame repeated on the bus or a very late
/// answer can look the same, so it counts only if it occurs at three requests in a row, or at more than a
/// third of several. An unanswered request may still be answered: that many further answers are no proof.
class AnswerCount {
  public:
    static constexpr unsigned kMostLate = 3;

    /// A request was sent.
    void asked() {
        points_ = points();
        if (!surplus_ && answered_ && owed_ != 0) --owed_;
        surplus_ = answered_ = false;
        if (owed_ < kMostLate) ++owed_;
    }
    /// Another master has sent a request.
    void asked_by_other() { owed_ = static_cast<std::uint8_t>(std::min(owed_ + 1U, 255U)); }
    /// An answer was received, to any request.
    void answered() {
        if (owed_ == 0) {
            surplus_ = true;
        } else {
            --owed_;
            answered_ = true;
        }
    }
    /// Too many answers since the last request.
    bool surplus() const { return surplus_; }
    /// More than one module answers; until two requests have been answered once each.
    bool several() const { return points() >= kProof; }

  private:
    static constexpr std::uint8_t kProof = 5;
    std::uint8_t points() const {
        if (surplus_) return static_cast<std::uint8_t>(std::min(points_ + 2U, kProof + 1U));
        return static_cast<std::uint8_t>(points_ - (answered_ && points_ != 0 ? 1 : 0));
    }

    std::uint8_t owed_ = 0;    ///< requests that may still be answered
    std::uint8_t points_ = 0;  ///< plus two for each request with too many answers, minus one for each other
    bool surplus_ = false;
    bool answered_ = false;
};

}  // namespace nplc::protocol
