#pragma once

#include <deque>
#include <optional>

#include "base/time.h"
#include "ports/serial.h"

namespace nplc::boards {

/// The serial line of one person's program. Of what may have waited longer than 1 s to be read, because the
/// process was halted, only reads and the commands stop, safe and hold are passed on.
class TimelyPort final : public ports::SerialPort {
  public:
    explicit TimelyPort(ports::SerialPort& port) : port_(port) {}

    /// Before each read.
    void look(base::Instant now, std::uint8_t gateway_address);
    /// When look() is wanted at the latest: what came between two of them is as old as the time between.
    base::Instant next_look() const;

    std::size_t write(std::span<const std::uint8_t> bytes) override { return port_.write(bytes); }
    std::size_t read(std::span<ports::ReceivedByte> out) override;
    bool transmitter_idle() override { return port_.transmitter_idle(); }

  private:
    void sift(std::uint8_t gateway_address);

    ports::SerialPort& port_;
    std::optional<base::Instant> looked_;
    std::deque<std::uint8_t> kept_;
};

}  // namespace nplc::boards
