#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::ports {

struct ReceivedByte {
    std::uint8_t value = 0;
    bool framing_error = false;
};

/// Receive errors of a line, modulo 2^32.
struct LineFaults {
    std::uint32_t framing = 0;  ///< stop bit missing, breaks included
    std::uint32_t overruns =
        0;  ///< characters lost because the chip's or the driver's buffer was full, at least
};

/// One asynchronous serial line, full duplex. No call blocks.
class SerialPort {
  public:
    /// Queues bytes for transmission in order and returns how many were accepted (fewer when the buffer is
    /// full).
    virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;

    /// Moves received characters into `out`, oldest first, and returns their number.
    virtual std::size_t read(std::span<ReceivedByte> out) = 0;

    /// True once the stop bit of the last accepted byte has left the line.
    virtual bool transmitter_idle() = 0;

    /// Zeros if the port does not count.
    virtual LineFaults faults() const { return {}; }

  protected:
    ~SerialPort() = default;
};

}  // namespace nplc::ports
