#pragma once

#include "ports/serial.h"

namespace nplc::hal_mcu {

/// A null line: discards all output and receives nothing.
class NoLine final : public ports::SerialPort {
  public:
    std::size_t write(std::span<const std::uint8_t> bytes) override { return bytes.size(); }
    std::size_t read(std::span<ports::ReceivedByte>) override { return 0; }
    bool transmitter_idle() override { return true; }
    ports::LineFaults faults() const override { return {}; }
};

}  // namespace nplc::hal_mcu
