#pragma once

#include <optional>

#include "base/time.h"
#include "gateway/controller.h"
#include "hal_linux/connections.h"
#include "listener/listener.h"
#include "ports/clock.h"
#include "protocol/mactalk.h"

namespace nplc::boards {

/// Transfers messages and answers between the sockets of a user port, its listener and a controller without a
/// line of its own.
class Exchange {
  public:
    /// `clock`: that of the clients, read once more before a message is handed out, since the process may
    /// have been halted after the time that bring() is called with. Null: that time counts.
    Exchange(hal_linux::Connections& connections, Listener& listener, ports::Clock* clock = nullptr)
        : connections_(connections), listener_(listener), clock_(clock) {
        listener.ask_who_is_there(
            [&connections](Listener::Id client) { return connections.is_open(client); });
    }

    /// To be called before the controller's poll: reads received data and submits the next message. `now`:
    /// time of the clients; `controllers_now`: time of the controller, which differs in a simulation.
    void bring(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    /// To be called after it: sends the answers.
    void take_back(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    /// Latest time of the next bring().
    base::Instant next(base::Instant now) const;

  private:
    void hear(hal_linux::Connections::Id client, base::Instant now);
    void look(base::Instant now);
    void expect(const protocol::mactalk::Request& message);
    void collect(gateway::Controller& controller, base::Instant now, base::Instant controllers_now);
    bool has_ended(const gateway::UserPort& port, base::Instant now);
    void send_unsent(base::Instant now);
    void close_dropped();

    hal_linux::Connections& connections_;
    Listener& listener_;
    ports::Clock* clock_;
    protocol::mactalk::Answer expected_{};
    protocol::mactalk::ReplyDecoder reply_;  ///< decoder of the motor's answers
    bool is_whole_ = false;
    std::optional<base::Instant> last_sample_;
};

}  // namespace nplc::boards
