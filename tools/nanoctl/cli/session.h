#pragma once

#include <functional>
#include <memory>
#include <string>

#include "command_line/program.h"
#include "nanoctl/gateway_client.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl::cli {

using command_line::add_command;
using command_line::goes_on;
using command_line::Json;
using command_line::output_has_reader;
using command_line::UserError;

/// The last orders are finished and the motor is stopped within it, or something is wrong.
inline constexpr base::Milliseconds kHoldWait{10'000};

struct Common : command_line::Common {
    std::string symbols;
};

/// A gateway that answered, and how results are told.
class Session {
  public:
    explicit Session(const Common& common);

    GatewayClient& gateway() { return gateway_; }
    const Names& names() const { return names_; }
    bool json() const { return common_.json; }
    Status status() { return Status(gateway_.read_block(gw::STATUS)); }
    void pause(base::Microseconds time) { master_.pause(time); }
    base::Instant now() { return wire_->now(); }

    /// False if it was stopped instead, or after `patience`.
    bool wait_until_held(base::Milliseconds patience);

    /// A line for a person, or the same as a JSON document on one line, with "ok".
    void tell(const std::string& text, const Json& document) const {
        command_line::tell(common_, text, document);
    }

  private:
    const Common& common_;
    std::unique_ptr<mactalk_client::Wire> wire_;
    mactalk_client::Master master_;
    GatewayClient gateway_;
    Names names_;
};

/// Does the work of a subcommand with an open session; sets the exit code and tells what went wrong.
void work(Common& common, const std::function<void(Session&)>& what);

/// `add_transfers`: upload, verify, download. `add_controls`: run, stop, safe, hold, activate, reset.
/// `add_stepping`: step, scan. `add_status`: status, watch.
command_line::Subcommand<Common> add_break, add_controls, add_force, add_log, add_settings, add_status,
    add_stepping, add_transfers;

}  // namespace nplc::nanoctl::cli
