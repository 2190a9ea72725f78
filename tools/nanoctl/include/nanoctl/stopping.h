#pragma once

#include <stdexcept>

#include "nanoctl/gateway_client.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {

/// The text in every message about a stop, safe or hold that was not confirmed.
inline constexpr const char* kMayStillRun = "THE MACHINE MAY STILL BE RUNNING";

/// Timeout of a stop command.
inline constexpr base::Milliseconds kLongestStop{10'000};

class NotConfirmed : public mactalk_client::EndedWith<mactalk_client::kNotConfirmed> {
    using EndedWith::EndedWith;
};

/// Stop, safe or hold: sent before any request, and repeated until the gateway's status confirms it and the
/// motor can be commanded: for 10 s at the most, or 1 s after the gateway was seen to have it; it ends at
/// most 1 s later, independently of the answers. Returns that status. Throws NotConfirmed on any error,
/// Interrupted with the same text, and Refused for a hold of a sequence that does not run.
Status stop_machine(GatewayClient& gateway, gw::Command command);

}  // namespace nplc::nanoctl
