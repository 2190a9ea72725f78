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

/// A serial port that is reopened after its adapter was unplugged, or was not present at the start.
class ReconnectingUart {
  public:
    /// Empty, or a one-line error: then the port is missing until look() finds it.
    /// `lost`: fields of the message about its loss.
    std::string open(const hal_linux::UartSettings& settings, JournalFields lost = {});
    hal_linux::Uart& uart() { return *uart_; }
    bool gone() const { return uart_->gone(); }
    /// True if it has come back, with another descriptor. Logs its loss and its return.
    bool look(AxisJournal& journal, base::Instant now);
    /// Latest time of the next look().
    base::Instant next_look() const { return retry_at_; }

  private:
    std::string path_;
    std::string problem_;  ///< error of the last attempt to open it; empty: none
    JournalFields lost_;
    std::unique_ptr<hal_linux::Uart> uart_;
    base::Instant retry_at_ = base::kNever;
};

/// A CAN interface that is reopened after its adapter was unplugged, or was not present at the start. Logs
/// its state changes; its user restarts it when it is bus-off.
class ReconnectingCan {
  public:
    /// An interface that is down can be opened; one that cannot be opened is missing until look() finds it.
    /// `lost`: fields of the messages that it is gone, down or off the bus.
    void open(const hal_linux::CanSettings& settings, JournalFields lost);
    hal_linux::SocketCan& can() { return *can_; }
    void look(AxisJournal& journal, base::Instant now);
    /// Latest time of the next look().
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell_presence(AxisJournal& journal);
    void tell_state(AxisJournal& journal);
    void tell_problem(AxisJournal& journal);

    std::string interface_;
    std::string problem_;  ///< error of the last attempt to open it; empty: none
    JournalFields lost_;
    std::unique_ptr<hal_linux::SocketCan> can_;
    bool told_gone_ = false;
    std::string told_problem_;
    ports::CanState told_ = ports::CanState::active;
    base::Instant retry_at_ = base::kNever;
};

/// A serial line that is read only after open() and until it has no more data.
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
