#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nanoctl/gateway_client.h"

namespace nplc::nanoctl {

/// FORCE_IN and FORCE_OUT: bits 7..0 levels, 15..8 what is forced.
struct Forces {
    std::uint32_t in = 0;
    std::uint32_t out = 0;

    /// Everything of `kept` is forced as there; more may be.
    bool hold(const Forces& kept) const;
};
Forces read_forces(GatewayClient& gateway);

/// Keeps these forces from ending by themselves. If they are not there any more, or others, nothing is
/// renewed, and it returns what is known of who ended them: "the forces were ended by a safe command".
std::optional<std::string> renew_forces(GatewayClient& gateway, const Forces& kept);

}  // namespace nplc::nanoctl
