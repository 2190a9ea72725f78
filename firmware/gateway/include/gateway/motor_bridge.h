#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"
#include "motor/motor.h"
#include "ports/serial.h"
#include "protocol/mactalk.h"

namespace nplc::gateway {

/// What of a client's messages to the motor is carried over FlexMAC: register reads and writes, answered as
/// the motor would. A block is 16 longwords one after the other.
class MotorBridge {
  public:
    explicit MotorBridge(motor::Motor& motor) : motor_(motor) {}

    static bool carries(protocol::mactalk::Kind kind);

    /// Read, block read or write. What was begun before is dropped.
    void begin(const protocol::mactalk::Request& request, base::Instant now);
    void drop();

    enum class State : std::uint8_t { under_way, answered, failed };
    /// `pause`: least time between two of the accesses. `answered` and `failed` come once.
    State poll(base::Instant now, base::Microseconds pause);
    /// When it must be polled at the latest if the motor's driver has nothing new.
    base::Instant next_poll(base::Instant now, base::Microseconds pause) const;
    /// After `answered`.
    protocol::mactalk::EncodedReply answer() const;
    /// The same of a read, as the motor has the bytes.
    std::span<const std::uint8_t> data() const { return data_; }

  private:
    bool is_read() const { return request_.kind != protocol::mactalk::Kind::write; }
    std::size_t wanted_bytes() const;
    std::optional<motor::Access> next_access() const;
    State take(base::Instant now);

    motor::Motor& motor_;
    protocol::mactalk::Request request_;
    std::array<std::uint8_t, protocol::mactalk::kMaxReplyData> data_;
    std::size_t have_ = 0;
    std::uint8_t failures_ = 0;
    bool asked_ = false;
    base::Instant begun_{};
    base::Instant ended_{};  ///< of the access before
};

}  // namespace nplc::gateway
