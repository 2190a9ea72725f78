#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hal_linux/byte_server.h"
#include "protocol/mactalk.h"
#include "sim/text.h"

namespace nplc::sim {

/// Several clients on one MacTalk line: only whole messages go onto it, one at a time, and what comes back is
/// for the client whose message it answers. A message without an answer keeps the line for a while, unless
/// the same client asks again.
class SharedLine {
  public:
    static constexpr Time kLongestAnswer = std::chrono::milliseconds{1'500};

    explicit SharedLine(hal_linux::ByteServer& server);

    /// What is to be put on the line now.
    std::vector<std::uint8_t> to_line(Time now, std::uint8_t gateway_address);
    void from_line(std::span<const std::uint8_t> bytes, Time now);

  private:
    struct Frame {
        std::size_t seat = 0;
        protocol::mactalk::Kind kind{};
        std::vector<std::uint8_t> bytes;
    };

    void listen(std::size_t seat, std::uint8_t gateway_address);
    std::deque<Frame>::iterator next_frame();
    void expect(const Frame& frame, Time now);

    hal_linux::ByteServer& server_;
    std::vector<protocol::mactalk::RequestDecoder> decoders_;
    std::deque<Frame> frames_;
    std::optional<std::size_t> asking_;  ///< the seat whose answer is to come
    std::size_t last_ = 0;               ///< the seat that asked last
    bool samples_ = false;
    Time until_{0};
    protocol::mactalk::ReplyDecoder answer_;
};

}  // namespace nplc::sim
