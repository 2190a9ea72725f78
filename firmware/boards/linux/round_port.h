#pragma once

#include "base/time.h"
#include "ports/serial.h"

namespace nplc::boards {

/// A serial line that is asked for what has come when open() says so, and then only until it has no more.
class RoundPort final : public ports::SerialPort {
  public:
    explicit RoundPort(ports::SerialPort& port) : port_(port) {}
    void open(base::Instant now) {
        opened_ = now;
        is_open_ = true;
    }
    base::Instant opened() const { return opened_; }

    std::size_t write(std::span<const std::uint8_t> bytes) override { return port_.write(bytes); }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        if (!is_open_) return 0;
        const std::size_t count = port_.read(out);
        is_open_ = count == out.size();
        return count;
    }
    bool transmitter_idle() override { return port_.transmitter_idle(); }

  private:
    ports::SerialPort& port_;
    bool is_open_ = true;
    base::Instant opened_{};
};

}  // namespace nplc::boards
