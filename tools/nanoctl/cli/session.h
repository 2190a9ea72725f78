#pragma once

#include <functional>
#include <memory>
#include <optional>
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

struct Common : command_line::Common {
    std::string symbols;
};

/// A gateway, and how results are printed.
class Session {
  public:
    /// Throws unless the gateway answers.
    explicit Session(const Common& common);
    /// Without a request to it. `holding`: of a serial line.
    Session(const Common& common, host::ByteClient::Holding holding);

    GatewayClient& gateway() { return gateway_; }
    /// The names of --sym; numbers, and a note on standard error, if it cannot be read or belongs to another
    /// table.
    const Names& names();
    /// Throws UserError where names() prints a note.
    const Names& right_names();
    bool json() const { return common_.json; }
    /// The file of --sym; empty without.
    const std::string& symbols() const { return common_.symbols; }
    Status status() { return Status(gateway_.read_block(gw::STATUS)); }
    /// Releases a serial line for the time, if another program shares it in turns.
    void pause(base::Microseconds time);
    base::Instant now() { return wire_->now(); }

    /// False if it was stopped instead, or after `patience`.
    bool wait_until_held(base::Milliseconds patience);

    /// A line for the user, or the same as a JSON document on one line, with "ok".
    void tell(const std::string& text, const Json& document) const {
        command_line::tell(common_, text, document);
    }

    void progress(const std::string& text) const { command_line::progress(common_, text); }

  private:
    Names read_names();

    const Common& common_;
    std::unique_ptr<host::ByteClient> wire_;
    mactalk_client::Master master_;
    GatewayClient gateway_;
    std::optional<Names> names_;
};

/// Executes a stop command: without any check before it, and every error says that the machine may still be
/// running.
void stop_work(Common& common, const std::function<void(Session&)>& what);

/// `add_transfers`: upload, verify, download. `add_controls`: run, stop, safe, hold, activate, reset.
/// `add_set_points`: set-points, recipe. `add_stepping`: step, scan. `add_status`: status, watch.
/// `add_firmware`: firmware. `add_operating`: operate.
command_line::Subcommand<Common> add_break, add_controls, add_firmware, add_force, add_log, add_operating,
    add_set_points, add_settings, add_status, add_stepping, add_transfers;

}  // namespace nplc::nanoctl::cli
