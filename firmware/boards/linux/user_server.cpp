#include "user_server.h"

#include <utility>

namespace nplc::boards {

std::string UserServer::open(const std::string& endpoint, const hal_linux::ByteServer::Settings& settings,
                             faces::Seat* operators, const std::string& password) {
    auto opened = hal_linux::Connections::open(endpoint, settings);
    if (!opened.connections) return opened.error;
    serve(std::move(opened.connections), operators, password);
    return {};
}

void UserServer::serve(std::unique_ptr<hal_linux::Connections> connections, faces::Seat* operators,
                       const std::string& password) {
    exchange_.reset();
    connections_ = std::move(connections);
    listener_ = std::make_unique<Listener>(
        Listener::Options{.name = connections_->name(), .operators = operators, .password = password});
    exchange_.emplace(*connections_, *listener_, &clock_);
}

void UserServer::bring(gateway::Controller& controller, const Listener::Addresses& addresses,
                       base::Instant now) {
    listener_->set_addresses(addresses);
    exchange_->bring(controller, now, now);
}

}  // namespace nplc::boards
