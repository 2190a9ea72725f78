#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::ports {

struct ReceivedByte {
    std::uint8_t value = 0;
    bool framing_error = false;
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

  protected:
    ~SerialPort() = default;
};

}  // namespace nplc::ports
