#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"

namespace nplc::macreg {

/// A stretch of a MacTalk line's bytes (001 §5.1) that belong together.
struct Frame {
    enum class Kind : std::uint8_t {
        message,  ///< head, complements and end are right
        accept,   ///< 11h x3
        broken,   ///< began as a message; `flaw` says where it went wrong
        noise,    ///< no message's bytes
    };
    Kind kind = Kind::noise;
    base::Instant at{};  ///< of its first byte
    std::vector<std::uint8_t> bytes{};
    std::string flaw{};
};

/// Cuts a stream into frames and names what is wrong with those that no receiver takes; loses no byte.
/// Requests and answers may come mixed in one stream. A new head ends whatever was under way, so after noise
/// the next whole message is one.
class FrameCutter {
  public:
    /// `longest_pause` within a message; the manuals bound none, so it only says when to call one cut off.
    explicit FrameCutter(base::Microseconds longest_pause) : longest_pause_(longest_pause) {}

    void receive(std::uint8_t byte, base::Instant at);
    /// Nothing came until now.
    void pass(base::Instant now);
    /// Nothing more will come.
    void finish();
    std::vector<Frame> take();
    /// Since when something is under way.
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
    std::size_t flaw_at_ = 0;  ///< bytes up to the one that was wrong
    std::vector<Frame> ready_;
};

}  // namespace nplc::macreg
