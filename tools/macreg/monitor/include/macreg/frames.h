#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"

namespace nplc::macreg {

/// A sequence of bytes of a MacTalk line (001 §5.1) that belong together.
struct Frame {
    enum class Kind : std::uint8_t {
        message,  ///< head, complements and end are right
        accept,   ///< 11h x3
        broken,   ///< began as a message; `flaw` says where it went wrong
        noise,    ///< bytes of no message
    };
    Kind kind = Kind::noise;
    base::Instant at{};  ///< of its first byte
    std::vector<std::uint8_t> bytes{};
    std::string flaw{};
};

/// Splits a stream into frames and reports what is wrong with those that no receiver accepts; loses no byte.
/// Requests and answers may be mixed in one stream. A new head ends any pending frame, so after noise the
/// next complete message is recognised.
class FrameCutter {
  public:
    /// `longest_pause` within a message; the manuals give no limit, so it only decides when a frame is
    /// reported as cut off.
    explicit FrameCutter(base::Microseconds longest_pause) : longest_pause_(longest_pause) {}

    void receive(std::uint8_t byte, base::Instant at);
    /// No byte was received until now.
    void pass(base::Instant now);
    /// End of the stream.
    void finish();
    std::vector<Frame> take();
    /// Start of the pending frame.
    std::optional<base::Instant> since() const {
        return times_.empty() ? std::nullopt : std::optional(times_.front());
    }

  private:
    enum class State : std::uint8_t { hunting, message, broken };

    void emit(Frame::Kind kind, std::string flaw = {});
    bool begin_at_head();
    void take_pair();
    void shift_head();
    void fault(std::string flaw);
    std::string cut_off() const;

    base::Microseconds longest_pause_;
    State state_ = State::hunting;
    std::vector<std::uint8_t> bytes_;
    std::vector<base::Instant> times_;
    std::string flaw_;
    std::size_t flaw_at_ = 0;  ///< bytes before the wrong one
    std::vector<Frame> ready_;
};

}  // namespace nplc::macreg
