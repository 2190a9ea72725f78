#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::ports {

struct ReceivedByte {
    std::uint8_t value = 0;
    bool framing_error = false;
};

/// What a line's receiver lost or could not read, modulo 2^32.
struct LineFaults {
    std::uint32_t framing = 0;   ///< stop bit missing, breaks included
    std::uint32_t overruns = 0;  ///< characters that found the chip's or our own buffer full, at least
};

/// One asynchronous serial line, full duplex. No call blocks.
class SerialPort {
  public:
    /// Takes bytes for transmission in order and answers how many it took (fewer when its buffer is full).
    virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;

    /// Moves received characters into `out`, oldest first, and answers how many.
    virtual std::size_t read(std::span<ReceivedByte> out) = 0;

    /// True once the stop bit of the last byte taken has left the line.
    virtual bool transmitter_idle() = 0;

    /// None where the port does not count.
    virtual LineFaults faults() const { return {}; }

  protected:
    ~SerialPort() = default;
};

}  // namespace nplc::ports
