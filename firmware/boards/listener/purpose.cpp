#include "listener/purpose.h"

#include "gateway/user_port.h"
#include "registers/gateway.h"

namespace nplc::boards {

namespace gw = registers::gateway;
using protocol::mactalk::Kind;

Purpose purpose_of(const protocol::mactalk::Request& request, const Addresses& addresses) {
    if (request.kind == Kind::read || request.kind == Kind::read_block || request.kind == Kind::read_samples)
        return Purpose::reads;
    const bool is_own = request.address == addresses.gateway;
    const bool is_motors =
        !is_own && (request.address == addresses.motor || request.address == protocol::mactalk::kEveryone);
    if (is_motors && gateway::UserPort::is_stop(request)) return Purpose::stops;
    if (request.kind != Kind::write || !is_own || request.reg != gw::COMMAND || request.length > 4)
        return Purpose::operates;
    switch (request.value) {
        case static_cast<std::uint32_t>(gw::Command::stop):
        case static_cast<std::uint32_t>(gw::Command::safe):
        case static_cast<std::uint32_t>(gw::Command::hold):
            return Purpose::stops;
        default:
            return Purpose::operates;
    }
}

bool needs_seat(const protocol::mactalk::Request& request, const Addresses& addresses) {
    const bool is_free = request.kind == Kind::write && request.address == addresses.gateway &&
                         gw::is_for_everybody(request.reg, request.value);
    return !is_free && purpose_of(request, addresses) == Purpose::operates;
}

}  // namespace nplc::boards
