#pragma once

#include <vector>

#include "causes/finding.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {

/// Why nothing moves, or that it moves.
struct Why {
    std::vector<causes::Finding> findings{};  ///< what to mend first in front; never empty
    bool knows_motor = false;      ///< they are those of `macreg why`; else the gateway's own alone
    bool motor_is_silent = false;  ///< it was asked, and could not be read
};

/// What the gateway tells without its motor being asked.
Why why_of_gateway(GatewayClient& gateway, const Status& status);
/// The same with the motor's registers, of which some 80 are read through the gateway.
Why ask_why(GatewayClient& gateway, const Status& status);

}  // namespace nplc::nanoctl
