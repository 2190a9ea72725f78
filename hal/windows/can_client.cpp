#include "host/can_client.h"

#include "host/endpoint.h"

namespace nplc::host {

CanClient::Opened CanClient::open(const std::string& interface) {
    return {nullptr,
            Endpoint::text(Endpoint::Kind::can, interface) +
                ": Windows has no CAN interfaces of its own; use Linux for this",
            true};
}

std::string CanClient::forms() {
    return {};
}

}  // namespace nplc::host
