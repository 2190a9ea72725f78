#pragma once

#include <array>
#include <optional>

#include "line_stops.h"
#include "modbus/session.h"
#include "ports/serial.h"
#include "protocol/modbus_rtu.h"
#include "unit_set.h"

namespace nplc::modbus {

/// The axes as slaves on a serial line, without line and clock: characters in, answers out. An answer that
/// is not ready when the master already speaks to another slave is dropped; its request is carried out.
class RtuSlave {
  public:
    struct Options {
        std::uint32_t baud = 19'200;
        std::uint8_t unit = 1;  ///< of the first axis, where Settings::units has none
        Settings settings{};
    };
    RtuSlave(const Options& options, const faces::Axes& axes);

    /// To be called once, before all else; `bell` wakes the thread.
    void join(faces::Bell& bell, base::Instant now);
    /// Characters read at `now`, perhaps none, which arrived later than `arrived`.
    void take(std::span<const ports::ReceivedByte> bytes, base::Instant arrived, base::Instant now);
    /// To be called after each take().
    void poll(base::Instant now);
    /// The part of the answer still to send; empty while the silence before it has not passed.
    std::span<const std::uint8_t> out(base::Instant now) const;
    void note_sent(std::size_t count);
    /// Time of the next take() and poll(), unless characters come or the bell rings before.
    base::Instant due(base::Instant now) const;

  private:
    void note_frame(base::Instant arrived, base::Instant now);
    void note_stop(base::Instant now);
    void give_up(base::Instant now);
    void hear_another(base::Instant now);
    std::optional<Answer> hand_over(base::Instant now);
    void serve(base::Instant now);
    void answer(const Answer& pdu) { frame_ = protocol::modbus::RtuFrame(unit_, pdu.bytes()); }
    bool is_pending() const { return request_size_ != 0 || frame_ || session_->is_waiting(); }

    base::Microseconds gap_;
    UnitSet set_;
    std::optional<Session> session_;
    protocol::modbus::RtuReader reader_;
    StopFinder finder_;

    base::Instant heard_{};  ///< the last character
    std::uint8_t unit_ = 0;  ///< slave of the request in progress
    std::array<std::uint8_t, protocol::modbus::kMostPdu> request_{};
    base::Instant request_ended_{};  ///< its last character
    base::Instant request_arrived_{};
    std::size_t request_size_ = 0;                     ///< 0: no pending request
    std::optional<base::Instant> asked_{};             ///< an image was requested
    std::optional<protocol::modbus::RtuFrame> frame_;  ///< the answer
    std::size_t sent_ = 0;                             ///< sent bytes of it
};

}  // namespace nplc::modbus
