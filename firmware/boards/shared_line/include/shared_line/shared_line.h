#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hal_linux/byte_server.h"
#include "protocol/mactalk.h"

namespace nplc::boards {

/// Several clients on one MacTalk line: only whole messages go onto it, one at a time, and what comes back is
/// for the client whose message it answers. Clients take turns. A message that got no answer keeps the line
/// for a while, so that its client may ask once why; whom nobody answered the last time is waited for
/// briefly, and what is for nobody on the line not at all. What a client that is gone left behind is dropped.
class SharedLine {
  public:
    using Time = std::chrono::nanoseconds;
    static constexpr Time kLongestAnswer = std::chrono::milliseconds{1'500};
    static constexpr Time kBriefly = std::chrono::milliseconds{150};  ///< beside the message's own time

    struct Addresses {
        std::uint8_t gateway;
        std::uint8_t motor;
    };

    explicit SharedLine(hal_linux::ByteServer& server);

    /// What is to be put on the line now.
    std::vector<std::uint8_t> to_line(Time now, const Addresses& addresses);
    /// When to_line() may have something more if no client sends anything; nothing: never.
    std::optional<Time> next_turn(Time now) const;
    void from_line(std::span<const std::uint8_t> bytes, Time now);

  private:
    struct Frame {
        protocol::mactalk::Kind kind{};
        std::uint8_t address = 0;
        std::vector<std::uint8_t> bytes;
    };
    struct Seat {
        protocol::mactalk::RequestDecoder decoder;
        std::deque<Frame> frames;
        std::uint64_t visit = 0;
        bool unanswered = false;  ///< its last message
    };

    static void take_byte(Seat& seat, std::uint8_t byte);
    void listen(std::size_t number, std::uint8_t gateway_address);
    void welcome(Seat& seat, std::size_t number, std::uint64_t visit);
    std::optional<std::size_t> next_seat() const;
    void expect(std::size_t number, const Frame& frame, Time now, const Addresses& addresses);
    void end_turn(bool answered);

    hal_linux::ByteServer& server_;
    std::vector<Seat> seats_;
    std::optional<std::size_t> asking_;  ///< the seat whose answer is to come
    bool asked_again_ = false;           ///< in this turn
    bool asker_is_gone_ = false;
    std::size_t last_ = 0;  ///< the seat that asked last
    bool samples_ = false;
    Time until_{0};
    Time sent_{0};
    protocol::mactalk::ReplyDecoder answer_;
};

}  // namespace nplc::boards
