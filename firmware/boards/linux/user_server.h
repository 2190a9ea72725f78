#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "gateway/controller.h"
#include "hal_linux/connections.h"
#include "listener/exchange.h"
#include "listener/listener.h"

namespace nplc::boards {

/// The user's port: a socket, a terminal or a serial line, for all clients that it can have.
class UserServer {
  public:
    /// Empty, or one line. `operators`: who may operate, of all clients. `password`: empty, none is asked
    /// for.
    std::string open(const std::string& endpoint, const hal_linux::ByteServer::Settings& settings,
                     faces::Seat* operators, const std::string& password);
    void serve(std::unique_ptr<hal_linux::Connections> connections, faces::Seat* operators,
               const std::string& password);
    const std::string& name() const { return connections_->name(); }
    int descriptor() const { return connections_->descriptor(); }
    unsigned wrong_passwords() const { return listener_->wrong_passwords(); }
    unsigned turned_away() const { return connections_->turned_away(); }

    void restarted() { listener_->restarted(); }
    /// Before the controller's poll, where something has come or it is time.
    void bring(gateway::Controller& controller, const Listener::Addresses& addresses, base::Instant now);
    /// After it.
    void take_back(gateway::Controller& controller, base::Instant now) {
        exchange_->take_back(controller, now, now);
    }
    /// When bring() is wanted at the latest.
    base::Instant next(base::Instant now) const { return exchange_->next(now); }

  private:
    std::unique_ptr<hal_linux::Connections> connections_;
    std::unique_ptr<Listener> listener_;
    std::optional<Exchange> exchange_;
};

}  // namespace nplc::boards
