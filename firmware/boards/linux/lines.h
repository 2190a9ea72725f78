#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "hal_linux/socket_can.h"
#include "hal_linux/uart.h"
#include "journal.h"
#include "ports/serial.h"

namespace nplc::boards {

/// A serial port that is looked for again when its adapter was pulled out, or was not there at the start.
class ReopenedUart {
  public:
    /// Empty, or one line: then it is gone until look() finds it.
    std::string open(const std::string& who, const hal_linux::UartSettings& settings);
    hal_linux::Uart& uart() { return *uart_; }
    bool gone() const { return uart_->gone(); }
    /// True if it has come back, with another descriptor. Says so, and says when it has gone.
    bool look(Journal& journal, base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell(Journal& journal, const std::string& problem);

    std::string who_;
    std::string path_;
    std::string problem_;  ///< why it could not be opened the last time; empty: it was
    std::unique_ptr<hal_linux::Uart> uart_;
    base::Instant retry_at_ = base::kNever;
};

/// A CAN interface that is looked for again when its adapter was pulled out, or was not there at the start.
/// Says what happens to it; who uses it restarts it when it is off the bus.
class ReopenedCan {
  public:
    /// An interface that is down may be opened; one that cannot be is gone until look() finds it.
    void open(const std::string& who, const hal_linux::CanSettings& settings);
    hal_linux::SocketCan& can() { return *can_; }
    void look(Journal& journal, base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell_state(Journal& journal);
    void tell_problem(Journal& journal);

    std::string who_;
    std::string interface_;
    std::string problem_;  ///< why it could not be opened the last time; empty: it was
    std::unique_ptr<hal_linux::SocketCan> can_;
    bool told_gone_ = false;
    std::string told_problem_;
    ports::CanState told_ = ports::CanState::active;
    base::Instant retry_at_ = base::kNever;
};

/// A serial line that is asked for what has come when open() says so, and then only until it has no more.
class GatedPort final : public ports::SerialPort {
  public:
    explicit GatedPort(ports::SerialPort& port) : port_(port) {}
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
