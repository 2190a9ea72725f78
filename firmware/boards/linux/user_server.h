#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "gateway/controller.h"
#include "hal_linux/connections.h"
#include "hal_linux/steady_clock.h"
#include "listener/exchange.h"
#include "listener/listener.h"

namespace nplc::boards {

/// The user port for many clients: a socket, a terminal or a serial line.
class UserServer {
  public:
    /// Empty, or a one-line error. `operators`: decides which client is the operator. `password`: empty: none
    /// required.
    std::string open(const std::string& endpoint, const hal_linux::ByteServer::Settings& settings,
                     faces::Seat* operators, const std::string& password);
    void serve(std::unique_ptr<hal_linux::Connections> connections, faces::Seat* operators,
               const std::string& password);
    const std::string& name() const { return connections_->name(); }
    int descriptor() const { return connections_->descriptor(); }
    unsigned wrong_passwords() const { return listener_->wrong_passwords(); }
    unsigned turned_away() const { return connections_->turned_away(); }

    void restarted() { listener_->restarted(); }
    /// To be called before the controller's poll, when data have arrived or next() is due.
    void bring(gateway::Controller& controller, const Listener::Addresses& addresses, base::Instant now);
    /// To be called after it.
    void take_back(gateway::Controller& controller, base::Instant now) {
        exchange_->take_back(controller, now, now);
    }
    /// Latest time of the next bring().
    base::Instant next(base::Instant now) const { return exchange_->next(now); }

  private:
    hal_linux::SteadyClock clock_;
    std::unique_ptr<hal_linux::Connections> connections_;
    std::unique_ptr<Listener> listener_;
    std::optional<Exchange> exchange_;
};

}  // namespace nplc::boards
