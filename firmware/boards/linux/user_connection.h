#pragma once

#include <optional>
#include <string>

#include "config.h"
#include "hal_linux/event_loop.h"
#include "journal.h"
#include "lines.h"
#include "user_server.h"

namespace nplc::boards {

/// The user's port of an axis: a serial port, or a server for many clients; or none.
class UserConnection {
  public:
    explicit UserConnection(AxisJournal& journal) : journal_(journal) {}

    /// Empty, or why it cannot be had, one line; then it may be tried again, and the port is not served. A
    /// server stays open. A serial port has the stored speed, or the configured one where it cannot do that.
    /// `operators`: who may operate, of all clients.
    std::string open(const AxisConfig& config, std::uint32_t stored_baud, bool at_once,
                     faces::Seat& operators);
    /// For a new controller.
    void start();

    void watch_server(hal_linux::EventLoop& loop, std::uint32_t mark);
    void watch_serial_port(hal_linux::EventLoop& loop, std::uint32_t mark);
    void note_readable() { readable_ = true; }
    /// Before the controller's poll.
    void look(gateway::Controller& controller, const Listener::Addresses& addresses, base::Instant now);
    /// After it.
    void answer(gateway::Controller& controller, base::Instant now);
    /// After it. True if the serial port has come back with another descriptor.
    bool look_for_serial_port(base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look(base::Instant now) const;

  private:
    std::string open_server(const AxisConfig& config, bool at_once, faces::Seat& operators);
    void tell_unwanted(base::Instant now);
    std::string open_serial_port(const AxisConfig& config, std::uint32_t stored_baud);

    AxisJournal& journal_;
    std::optional<ReopenedUart> uart_;
    std::optional<UserServer> server_;  ///< on uart_ where there is one
    unsigned told_wrong_passwords_ = 0;
    unsigned told_turned_away_ = 0;
    base::Instant tell_again_{};
    bool is_terminal_ = false;
    bool readable_ = true;
};

}  // namespace nplc::boards
