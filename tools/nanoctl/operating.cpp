#include "nanoctl/operating.h"

#include <fmt/format.h>

namespace nplc::nanoctl {

Operator read_operator(GatewayClient& gateway) {
    const std::uint32_t word = gateway.read(gw::OPERATOR);
    return {.way = static_cast<gw::OperatorWay>(word & gw::kOperatorWay),
            .is_you = (word & gw::kOperatorIsYou) != 0,
            .took_from_you = (word & gw::kOperatorTookFromYou) != 0,
            .peer = gateway.read(gw::OPERATOR_PEER),
            .seconds_left = gateway.read(gw::OPERATOR_LEFT)};
}

std::string in_words(const Operator& who) {
    const std::uint32_t peer = who.peer;
    switch (who.way) {
        case gw::OperatorWay::nobody:
            return "nobody";
        case gw::OperatorWay::unix_socket:
            return fmt::format("uid {} on the socket", peer);
        case gw::OperatorWay::tcp:
            return fmt::format("{}.{}.{}.{} over TCP", peer >> 24, peer >> 16 & 0xFF, peer >> 8 & 0xFF,
                               peer & 0xFF);
        case gw::OperatorWay::terminal:
            return "the client of the terminal";
        case gw::OperatorWay::serial_line:
            return "the client of the serial line";
        case gw::OperatorWay::panel:
            return "the panel";
        case gw::OperatorWay::plant:
            return "the plant";
        case gw::OperatorWay::other:
            break;
    }
    return "another client";
}

std::string why_seat_is_taken(GatewayClient& gateway) {
    const Operator who = read_operator(gateway);
    if (who.way == gw::OperatorWay::nobody) return std::string(gw::describe(gw::Result::seat_taken));
    return fmt::format("{} {}, for {} s more unless it goes on; `nanoctl operate --take` takes it over",
                       in_words(who), who.took_from_you ? "has taken over" : "operates", who.seconds_left);
}

}  // namespace nplc::nanoctl
