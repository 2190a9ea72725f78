#pragma once

#include <algorithm>
#include <cstdint>

namespace nplc::protocol {

/// Tells two MIDI modules at one address from answers that come late. A module answers each request once, so
/// that an answer to no request is another module's. A damaged bit, a frame that a bus repeats or an answer
/// that comes very late can look like one too: it counts when it comes at three requests in a row, or at more
/// than a third of several. A request without an answer may still be answered: that many answers more are no
/// proof.
class AnswerCount {
  public:
    static constexpr unsigned kMostLate = 3;

    /// A request is sent.
    void asked() {
        points_ = points();
        if (!surplus_ && answered_ && owed_ != 0) --owed_;
        surplus_ = answered_ = false;
        if (owed_ < kMostLate) ++owed_;
    }
    /// Another master has sent one.
    void asked_by_other() { owed_ = static_cast<std::uint8_t>(std::min(owed_ + 1U, 255U)); }
    /// An answer has come, to whatever request.
    void answered() {
        if (owed_ == 0) {
            surplus_ = true;
        } else {
            --owed_;
            answered_ = true;
        }
    }
    /// Since the last request.
    bool surplus() const { return surplus_; }
    /// More than one answers. Until two requests have been answered once.
    bool several() const { return points() >= kProof; }

  private:
    static constexpr std::uint8_t kProof = 5;
    std::uint8_t points() const {
        if (surplus_) return static_cast<std::uint8_t>(std::min(points_ + 2U, kProof + 1U));
        return static_cast<std::uint8_t>(points_ - (answered_ && points_ != 0 ? 1 : 0));
    }

    std::uint8_t owed_ = 0;    ///< requests that may still be answered
    std::uint8_t points_ = 0;  ///< two for each request with too many answers, less one for each other one
    bool surplus_ = false;
    bool answered_ = false;
};

}  // namespace nplc::protocol
