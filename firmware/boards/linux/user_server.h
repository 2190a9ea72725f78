#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "hal_linux/byte_server.h"
#include "ports/serial.h"
#include "shared_line/shared_line.h"

namespace nplc::boards {

/// The user's port as a socket or a pseudo-terminal: for the gateway a serial line, for many clients a line
/// of their own.
class UserServer final : public ports::SerialPort {
  public:
    /// With seats of its own number. Empty, or one line. `operators`: who may operate, of all clients.
    /// `password`: empty, none is asked for.
    std::string open(const std::string& endpoint, hal_linux::ByteServer::Settings settings,
                     faces::Seat* operators, const std::string& password);
    const std::string& name() const { return server_->name(); }
    int descriptor() const { return server_->descriptor(); }
    unsigned wrong_passwords() const { return line_->wrong_passwords(); }

    /// What has come by `now` is taken in by the next read().
    void look(base::Instant now, const SharedLine::Addresses& addresses) {
        now_ = now.time_since_epoch();
        look_for_ = addresses;
    }
    base::Instant next_turn(base::Instant now) const;

    std::size_t write(std::span<const std::uint8_t> bytes) override;
    std::size_t read(std::span<ports::ReceivedByte> out) override;
    bool transmitter_idle() override { return true; }

  private:
    void take_in(const SharedLine::Addresses& addresses);

    std::unique_ptr<hal_linux::ByteServer> server_;
    std::unique_ptr<SharedLine> line_;
    std::deque<std::uint8_t> waiting_;
    SharedLine::Time now_{0};
    std::optional<SharedLine::Addresses> look_for_;
};

}  // namespace nplc::boards
