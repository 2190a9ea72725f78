#include "listener/purpose.h"

#include "registers/gateway.h"

namespace nplc::boards {

namespace gw = registers::gateway;
using protocol::mactalk::Kind;

Purpose purpose_of(const protocol::mactalk::Request& request, std::uint8_t gateway_address) {
    if (request.kind == Kind::read || request.kind == Kind::read_block || request.kind == Kind::read_samples)
        return Purpose::reads;
    if (request.kind != Kind::write || request.address != gateway_address || request.reg != gw::COMMAND ||
        request.length > 4)
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

bool needs_seat(const protocol::mactalk::Request& request, std::uint8_t gateway_address) {
    const bool is_free = request.kind == Kind::write && request.address == gateway_address &&
                         gw::is_for_everybody(request.reg, request.value);
    return !is_free && purpose_of(request, gateway_address) == Purpose::operates;
}

}  // namespace nplc::boards
