#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"
#include "motor/motor.h"
#include "ports/serial.h"
#include "protocol/mactalk.h"

namespace nplc::gateway {

/// Carries a client's register reads and writes to the motor over FlexMAC, answered as the motor would. A
/// block is read as 16 longwords, one after the other.
class MotorBridge {
  public:
    explicit MotorBridge(motor::Motor& motor) : motor_(motor) {}

    static bool carries(protocol::mactalk::Kind kind);

    /// `request`: a read, block read or write. Drops the one before.
    void begin(const protocol::mactalk::Request& request, base::Instant now);
    /// Others' accesses are left alone.
    void drop();
    bool is_accessing() const { return asked_; }

    enum class State : std::uint8_t { under_way, answered, failed };
    /// `pause`: minimum time between two accesses. `answered` and `failed` are returned once.
    State poll(base::Instant now, base::Microseconds pause);
    /// Latest time of the next poll if the motor's driver has nothing new.
    base::Instant next_poll(base::Instant now, base::Microseconds pause) const;
    /// After `answered`.
    protocol::mactalk::EncodedReply answer() const;
    /// For a read, the register's bytes as the motor sends them.
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
    base::Instant ended_{};  ///< end of the previous access
};

}  // namespace nplc::gateway
