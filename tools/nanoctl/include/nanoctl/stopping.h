#pragma once

#include <stdexcept>

#include "nanoctl/gateway_client.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {

/// What every message says about a stop, safe or hold that was not seen to be done.
inline constexpr const char* kMayStillRun = "THE MACHINE MAY STILL BE RUNNING";

/// A stop is asked for so long.
inline constexpr base::Milliseconds kLongestStop{10'000};

class NotConfirmed : public mactalk_client::EndedWith<mactalk_client::kNotConfirmed> {
    using EndedWith::EndedWith;
};

/// Stop, safe or hold: sent before anything is asked, and again until the gateway's status shows that it was
/// done and that the motor can be told, for 10 s at the most. The status then. Throws NotConfirmed whatever
/// goes wrong, Interrupted with the same words, and Refused for a hold of a sequence that does not run.
Status stop_machine(GatewayClient& gateway, gw::Command command);

}  // namespace nplc::nanoctl
