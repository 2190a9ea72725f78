#pragma once

#include <optional>
#include <string>

#include "config.h"
#include "hal_linux/event_loop.h"
#include "journal.h"
#include "lines.h"
#include "user_server.h"

namespace nplc::boards {

/// An axis's user port: a serial port, a server for many clients, or none.
class UserConnection {
  public:
    explicit UserConnection(AxisJournal& journal) : journal_(journal) {}

    /// Empty, or a one-line error; then it may be retried, and the port is not served. A server stays open. A
    /// serial port has the stored baud rate, or the configured one if it does not support that. `operators`:
    /// decides which client is the operator.
    std::string open(const AxisConfig& config, std::uint32_t stored_baud, bool at_once,
                     faces::Seat& operators);
    /// To be called for a new controller.
    void start();

    void watch_server(hal_linux::EventLoop& loop, std::uint32_t mark);
    void watch_serial_port(hal_linux::EventLoop& loop, std::uint32_t mark);
    void note_readable() { readable_ = true; }
    /// To be called before the controller's poll.
    void look(gateway::Controller& controller, const Listener::Addresses& addresses, base::Instant now);
    /// To be called after it.
    void answer(gateway::Controller& controller, base::Instant now);
    /// To be called after it. True if the serial port has come back with another descriptor.
    bool look_for_serial_port(base::Instant now);
    /// Latest time of the next look().
    base::Instant next_look() const;

  private:
    std::string open_server(const AxisConfig& config, bool at_once, faces::Seat& operators);
    void tell_unwanted(base::Instant now);
    std::string open_serial_port(const AxisConfig& config, std::uint32_t stored_baud);

    AxisJournal& journal_;
    std::optional<ReconnectingUart> uart_;
    std::optional<UserServer> server_;  ///< on uart_ where there is one
    unsigned told_wrong_passwords_ = 0;
    unsigned told_turned_away_ = 0;
    base::Instant tell_again_{};
    bool is_terminal_ = false;
    bool readable_ = true;
    base::Instant server_due_{};  ///< worked out after the scan: before it, it would lengthen an edge's way
};

}  // namespace nplc::boards
