#pragma once

#include <cstdint>

#include "base/time.h"
#include "motor/stop_pace.h"
#include "ports/serial.h"
#include "protocol/mactalk.h"

namespace nplc::motor {

/// The motor's own MacTalk port (001 §5.1). The user port's messages pass through it; a motor that no longer
/// answers on its FastMAC line is stopped over it.
class MactalkLine final : public ports::SerialPort {
  public:
    /// `address`: the motor's. `longword`: MODE_REG has 32 bits.
    MactalkLine(ports::SerialPort& port, std::uint8_t address, bool longword)
        : port_(port), address_(address), longword_(longword) {}

    /// To be called at every poll. While `is_wanted`, MODE_REG := 0 is written and read back, as often as a
    /// blind stop, each time after 20 ms without a character of another master. True once the motor has
    /// accepted it and MODE_REG reads 0, or 11 while the motor brakes.
    bool stop(bool is_wanted, base::Instant now);
    /// Latest time of the next call.
    base::Instant next_poll(base::Instant now) const;

    /// For the user port; while a stop is wanted nothing is sent for it and nothing is received.
    std::size_t write(std::span<const std::uint8_t> bytes) override;
    std::size_t read(std::span<ports::ReceivedByte> out) override;
    bool transmitter_idle() override { return port_.transmitter_idle(); }
    ports::LineFaults faults() const override { return port_.faults(); }

  private:
    enum class Phase : std::uint8_t { passing, listening, writing, reading };

    void begin(Phase phase, protocol::mactalk::Kind kind, base::Instant now);
    bool receive(base::Instant now);
    bool take(const protocol::mactalk::Reply& reply, base::Instant now);

    ports::SerialPort& port_;
    std::uint8_t address_;
    bool longword_;
    Phase phase_ = Phase::passing;
    StopPace pace_;
    base::Instant due_{};    ///< of the next write
    base::Instant heard_{};  ///< last character
    base::Instant until_{};  ///< of the answer
    protocol::mactalk::EncodedRequest out_{};
    std::size_t sent_ = 0;
    protocol::mactalk::ReplyDecoder decoder_;
};

}  // namespace nplc::motor
