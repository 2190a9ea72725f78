#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "nanoctl/gateway_client.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl::cli {

enum Exit : int {
    kOk = 0,
    kRefused = 1,        ///< the gateway said no, or two tables differ
    kUsageOrFile = 2,    ///< wrong usage, or a file that cannot be read, written or understood
    kNoAnswer = 3,       ///< the port cannot be opened, or nobody answers
    kInterrupted = 130,  ///< by SIGINT or SIGTERM, before it was done
};

using Json = nlohmann::ordered_json;

/// Wrong usage or a file, in one line.
class UserError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The last orders are finished and the motor is stopped within it, or something is wrong.
inline constexpr base::Milliseconds kHoldWait{10'000};

/// What stands before or behind every subcommand.
struct Common {
    std::string port;
    std::uint32_t baud = 19'200;
    unsigned address = gw::kDefaultAddress;
    unsigned patience_ms = 150;
    unsigned attempts = 10;  ///< of each question
    bool json = false;
    std::string symbols;
    int exit_code = kOk;
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
    void tell(const std::string& text, Json document) const;

  private:
    const Common& common_;
    std::unique_ptr<mactalk_client::Wire> wire_;
    mactalk_client::Master master_;
    GatewayClient gateway_;
    Names names_;
};

/// Does the work of a subcommand with an open session; sets the exit code and tells what went wrong.
void work(Common& common, const std::function<void(Session&)>& what);
/// The same without a gateway.
void guard(Common& common, const std::function<void()>& what);

/// Tells what went wrong, with --json as a document too.
void fail(Common& common, int exit_code, const std::string& text);

/// Until SIGINT or SIGTERM came.
bool goes_on();

/// A subcommand that has the common options too.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& text);

}  // namespace nplc::nanoctl::cli
