#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <type_traits>

#include "arguments/arguments.h"
#include "host/byte_client.h"
#include "mactalk_client/line.h"

/// Common parts of the programs for a MacTalk line: options, exit codes, signals, output of results and
/// failures.
namespace nplc::command_line {

using enum mactalk_client::Exit;

using Json = nlohmann::ordered_json;

/// Usual speeds of lines, the most common one first. 001 and 002 have 19200 only; expansion modules and
/// converters may be set otherwise.
inline constexpr std::array<std::uint32_t, 11> kSpeeds{19'200, 9'600, 38'400,  57'600,  115'200, 4'800,
                                                       2'400,  1'200, 230'400, 460'800, 921'600};

/// A one-line message for the user, and the program's exit code. `details` become part of the document of
/// --json. Files that throw one with details, or call tell, include <nlohmann/json.hpp>.
class Failure : public mactalk_client::Ended {
  public:
    Failure(int exit_code, const std::string& what);
    Failure(int exit_code, const std::string& what, const Json& details);
    const Json& details() const { return *details_; }

  private:
    std::shared_ptr<const Json> details_;
};

/// Wrong usage or a file.
class UserError : public Failure {
  public:
    explicit UserError(const std::string& what) : Failure(kUsageOrFile, what) {}
};

/// The common options, given before or after a subcommand.
struct Common {
    std::string program;  ///< its name
    std::string port;
    std::string password_file;  ///< for a gateway's port that requires one; empty: none
    std::uint32_t baud = 19'200;
    bool has_baud = false;  ///< --baud was given
    std::uint32_t baud_or(std::uint32_t usual) const { return has_baud ? baud : usual; }
    unsigned address = 0;
    unsigned patience_ms = 150;
    unsigned attempts = 10;  ///< of each request
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

/// Does the work of a subcommand; sets the exit code and prints the error, if any.
void guard(Common& common, const std::function<void()>& what);

/// With what `what` takes: the common options, or a session made of them.
template <class Common, class Taken, class... Options>
void work(Common& common, void (*what)(Taken&, const Options&...), const Options&... options) {
    guard(common, [&] {
        if constexpr (std::is_same_v<std::remove_const_t<Taken>, Common>) {
            what(common, options...);
        } else {
            Taken session(common);
            what(session, options...);
        }
    });
}

template <class Common, class Taken, class Options>
Added<Options> add_command(arguments::App& app, Common& common, const std::string& name,
                           const std::string& text, void (*what)(Taken&, const Options&)) {
    return add_command<Options>(app, name, text,
                                [what, &common](const Options& options) { work(common, what, options); });
}
template <class Common, class Taken>
void add_command(arguments::App& app, Common& common, const std::string& name, const std::string& text,
                 void (*what)(Taken&)) {
    add_command(app, name, text).callback([what, &common] { work(common, what); });
}

/// Reads the command line and carries it out; the program's exit code.
int run(arguments::App& app, Common& common, int argc, char** argv);

/// Throws UserError without a port, LineError if it cannot be opened.
std::unique_ptr<host::ByteClient> open_port(
    const Common& common, host::ByteClient::Holding holding = host::ByteClient::Holding::alone);

/// What open_patiently waits with.
struct Waiting {
    std::function<base::Instant()> now;
    std::function<void(base::Microseconds)> sleep;
    std::function<bool()> goes_on;
    std::function<void()> tell;  ///< once, when it begins to wait for a program that is absent
};
/// Opens again until `end` what is full or absent. Returns what the last attempt did; what else is wrong with
/// the endpoint, and an interruption, end it at once.
host::ByteClient::Opened open_patiently(const std::function<host::ByteClient::Opened()>& open,
                                        base::Instant end, const Waiting& with);

/// How long a stop tries to reach the program that serves a socket: longer than a restart of it takes.
inline constexpr base::Milliseconds kLongestOpening{10'000};

/// open_port for a stop: waits kLongestOpening for the program that serves a socket, and says so once on
/// standard error. Throws Interrupted, too.
std::unique_ptr<host::ByteClient> open_for_stop(
    const Common& common, host::ByteClient::Holding holding = host::ByteClient::Holding::alone);

/// --password-file, or the environment's PROGRAM_PASSWORD_FILE.
void add_password_option(arguments::App& app, Common& common);

/// The same as open_port, and gives the password of --password-file to the gateway of this address, if its
/// port asks for one. Throws UserError for the file, Failure if the password is another one.
std::unique_ptr<host::ByteClient> open_with_password(
    const Common& common, std::uint8_t gateway,
    host::ByteClient::Holding holding = host::ByteClient::Holding::alone);
/// The same on a port that is open.
void give_password(const Common& common, std::uint8_t gateway, host::ByteClient& wire);

/// A line for a user, or the same as a JSON document on one line, with "ok".
void tell(const Common& common, const std::string& text, const Json& document);

/// A line on standard error that is drawn over, if a user is there to see it; empty removes it.
void progress(const Common& common, const std::string& text);

/// Until SIGINT or SIGTERM came. A second one ends the program at once.
bool goes_on();

/// False once who reads standard output is gone: what writes seldom learns of it here.
bool output_has_reader();

/// Throws mactalk_client::Interrupted if one came.
void look_for_interruption();

/// Calls `look` every `interval` until Ctrl-C, until the output has no reader, or for so many seconds if not
/// 0. Waits by session.pause, in pieces.
template <class Session, class Look>
void watch(Session& session, base::Milliseconds interval, double seconds, Look look) {
    constexpr base::Microseconds kPiece{100'000};
    const base::Instant begun = session.now();
    const base::Microseconds limit{static_cast<std::int64_t>(seconds * 1e6)};
    const auto ends = [&] {
        return !goes_on() || !output_has_reader() || (seconds > 0 && session.now() - begun >= limit);
    };
    while (!ends()) {
        look();
        const base::Instant next = session.now() + interval;
        do {
            session.pause(
                std::clamp<base::Microseconds>(next - session.now(), base::Microseconds{0}, kPiece));
        } while (session.now() < next && !ends());
    }
}

/// One document on one line.
std::string one_line(const Json& document);

}  // namespace nplc::command_line
