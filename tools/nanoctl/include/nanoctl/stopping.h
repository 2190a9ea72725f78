#pragma once

#include <cstdint>
#include <optional>
#include <string>

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

/// A motor that moves needs some time to stop and to confirm it; what lasts longer is an alarm.
class StopConfirmation {
  public:
    /// Statuses of one gateway in the order of their times. True if a stop is not confirmed and the link does
    /// not deliver, or kConfirmationWait of the gateway's time has passed since the first such status.
    bool is_overdue(const Status& status);

  private:
    std::optional<std::uint32_t> since_;  ///< uptime, ms
};

/// How long the motor has not confirmed the last stop, in ms of the gateway's time; 0 if it has. `status`:
/// the gateway's latest. Throws what GatewayClient does.
std::uint32_t stop_unconfirmed_ms(GatewayClient& gateway, const Status& status);

/// The status; while a stop is not confirmed and the link delivers, read again for kConfirmationWait at the
/// most. Throws what GatewayClient does.
Status status_after_stop(GatewayClient& gateway);

/// For a sequence that is held or stopped: empty, or that the motor has not confirmed its stop, with
/// kMayStillRun. Waits and throws as status_after_stop().
std::string doubt_of_stop(GatewayClient& gateway);

}  // namespace nplc::nanoctl
