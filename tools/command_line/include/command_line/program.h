#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

#include "arguments/arguments.h"
#include "host/byte_client.h"

/// What the programs that talk over a MacTalk line have in common: options, exit codes, signals, how results
/// and failures are told.
namespace nplc::command_line {

enum Exit : int {
    kOk = 0,
    kRefused = 1,        ///< the other end said no, or two things differ
    kUsageOrFile = 2,    ///< wrong usage, or a file that cannot be read, written or understood
    kNoAnswer = 3,       ///< the port cannot be opened, or nobody answers
    kInterrupted = 130,  ///< by SIGINT or SIGTERM, before it was done
};

using Json = nlohmann::ordered_json;

/// Speeds that lines have, the usual one first. 001 and 002 know 19200 only; expansion modules and converters
/// may be set otherwise.
inline constexpr std::array<std::uint32_t, 11> kSpeeds{19'200, 9'600, 38'400,  57'600,  115'200, 4'800,
                                                       2'400,  1'200, 230'400, 460'800, 921'600};

/// One line for a user and the program's exit code. `details` go into the document of --json. Who throws
/// one with details, or tells something, includes <nlohmann/json.hpp>.
class Failure : public std::runtime_error {
  public:
    Failure(int exit_code, const std::string& what);
    Failure(int exit_code, const std::string& what, const Json& details);
    int exit_code() const { return exit_code_; }
    const Json& details() const { return *details_; }

  private:
    int exit_code_;
    std::shared_ptr<const Json> details_;
};

/// Wrong usage or a file.
class UserError : public Failure {
  public:
    explicit UserError(const std::string& what) : Failure(kUsageOrFile, what) {}
};

/// What stands before or behind every subcommand.
struct Common {
    std::string program;  ///< its name
    std::string port;
    std::uint32_t baud = 19'200;
    bool has_baud = false;  ///< it was said
    std::uint32_t baud_or(std::uint32_t usual) const { return has_baud ? baud : usual; }
    unsigned address = 0;
    unsigned patience_ms = 150;
    unsigned attempts = 10;  ///< of each question
    bool json = false;
    int exit_code = kOk;
};

/// --port (or the environment's PROGRAM_PORT), --baud, --patience, --json. `of_whom` is "the gateway".
void add_line_options(arguments::App& app, Common& common, const std::string& of_whom);

/// Adds a subcommand, or several of a kind; their work ends in the program's `Options::exit_code`.
template <class Options>
using Subcommand = void(arguments::App& app, Options& common);

/// A subcommand that has the common options too.
arguments::App& add_command(arguments::App& app, const std::string& name, const std::string& text);

/// A subcommand and what its arguments fill; both last as long as the command line.
template <class Options>
struct Added {
    arguments::App& command;
    Options& options;
};

/// A subcommand that does `work` with its options.
template <class Options, class Work>
Added<Options> add_command(arguments::App& app, const std::string& name, const std::string& text, Work work) {
    const auto options = std::make_shared<Options>();
    arguments::App& command = add_command(app, name, text);
    command.callback([options, work] { work(*options); });
    return {command, *options};
}

/// Reads the command line and carries it out; the program's exit code.
int run(arguments::App& app, Common& common, int argc, char** argv);

/// Throws UserError without a port, LineError if it cannot be opened.
std::unique_ptr<host::ByteClient> open_port(
    const Common& common, host::ByteClient::Holding holding = host::ByteClient::Holding::alone);

/// Does the work of a subcommand; sets the exit code and tells what went wrong.
void guard(Common& common, const std::function<void()>& what);

/// A line for a user, or the same as a JSON document on one line, with "ok".
void tell(const Common& common, const std::string& text, const Json& document);

/// Until SIGINT or SIGTERM came. A second one ends the program at once.
bool goes_on();

/// False once who reads standard output is gone: what writes seldom learns of it here.
bool output_has_reader();

/// Throws mactalk_client::Interrupted if one came.
void look_for_interruption();

/// One document on one line.
std::string one_line(const Json& document);

}  // namespace nplc::command_line
