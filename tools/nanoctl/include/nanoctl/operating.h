#pragma once

#include <cstdint>
#include <string>

#include "nanoctl/gateway_client.h"

namespace nplc::nanoctl {

/// The operator of a gateway, as its registers OPERATOR to OPERATOR_LEFT show it to the requesting client.
struct Operator {
    gw::OperatorWay way = gw::OperatorWay::nobody;
    bool is_you = false;
    bool took_from_you = false;  ///< it took over from this client
    std::uint32_t peer = 0;
    std::uint32_t seconds_left = 0;
};
Operator read_operator(GatewayClient& gateway);
/// "uid 1000 on the socket", "127.0.0.1 over TCP", "the panel", "nobody".
std::string in_words(const Operator& who);
/// For a client that is not the operator: who is, and how to take over.
std::string why_seat_is_taken(GatewayClient& gateway);

}  // namespace nplc::nanoctl
