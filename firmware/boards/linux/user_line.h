#pragma once

#include <deque>
#include <string>

#include "hal_linux/connections.h"
#include "ports/serial.h"

namespace nplc::boards {

/// A serial line as the connection of a single, permanent client.
class UserLine final : public hal_linux::Connections {
  public:
    UserLine(ports::SerialPort& port, std::string name) : port_(port), name_(std::move(name)) {}

    const std::string& name() const override { return name_; }
    /// No descriptor: the owner of the port waits for its data.
    int descriptor() const override { return -1; }
    std::optional<Id> accept() override;
    Peer peer(Id) const override { return {.kind = Peer::Kind::serial_line}; }
    std::vector<Id> with_news() override { return {kClient}; }
    Got read(Id client, std::span<std::uint8_t> out) override;
    bool is_open(Id) const override { return true; }
    std::optional<std::size_t> write(Id client, std::span<const std::uint8_t> bytes) override;
    void listen_to(Id, bool) override {}
    void wait_to_write(Id, bool) override {}
    void close(Id) override {}

  private:
    static constexpr Id kClient = 1;

    ports::SerialPort& port_;
    std::string name_;
    std::deque<ports::ReceivedByte> received_;
    bool is_there_ = false;
};

}  // namespace nplc::boards
