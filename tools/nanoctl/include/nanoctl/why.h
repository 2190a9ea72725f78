#pragma once

#include <vector>

#include "causes/finding.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {

/// Diagnoses why nothing moves, or that it moves.
struct Why {
    std::vector<causes::Finding> findings{};  ///< the most urgent cause first; never empty
    bool knows_motor = false;                 ///< the findings of `macreg why`; else of the gateway alone
    bool motor_is_silent = false;             ///< the motor was to be read, and could not be
};

/// The gateway's own findings, without a request to its motor.
Why why_of_gateway(GatewayClient& gateway, const Status& status);
/// The same with the motor's registers, of which some 80 are read through the gateway.
Why ask_why(GatewayClient& gateway, const Status& status);

}  // namespace nplc::nanoctl
