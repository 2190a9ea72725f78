#include "command_line/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <thread>

#include "host/clock.h"
#include "host/endpoint.h"
#include "host/interruption.h"
#include "host/printable.h"
#include "host/terminal.h"
#include "mactalk_client/master.h"

namespace nplc::command_line {
namespace {

/// Of the environment: NANOCTL_PORT.
std::string variable(const Common& common, const std::string& what) {
    std::string name = common.program + "_" + what;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

/// Tells what went wrong, with --json as a document too.
void fail(Common& common, int exit_code, const std::string& text, const Json& details = Json::object()) {
    common.exit_code = exit_code;
    if (common.json) {
        Json whole{{"ok", false}, {"error", text}};
        whole.update(details);
        fmt::print("{}\n", one_line(whole));
    }
    host::complain(common.program + ": " + text);
}

void try_to(Common& common, const std::function<void()>& what) {
    try {
        what();
    } catch (const Failure& failure) {
        fail(common, failure.exit_code(), failure.what(), failure.details());
    } catch (const mactalk_client::Ended& error) {
        fail(common, error.exit_code(), error.what());
    } catch (const std::system_error&) {  // of fmt::print; reported below
    }
}

}  // namespace

Failure::Failure(int exit_code, const std::string& what) : Failure(exit_code, what, Json::object()) {}

Failure::Failure(int exit_code, const std::string& what, const Json& details)
    : Ended(exit_code, what), details_(std::make_shared<const Json>(details)) {}

void add_line_options(arguments::App& app, Common& common, const std::string& of_whom) {
    app.fallthrough();
    app.add_option("--port", common.port, fmt::format("Where {} is", of_whom))
        ->envname(variable(common, "PORT"));
    app.add_option("--baud", common.baud, "Speed of the line")
        ->capture_default_str()
        ->each([&common](const std::string&) { common.has_baud = true; });
    app.add_option("--patience", common.patience_ms,
                   "Milliseconds beyond the line's time to wait for an answer")
        ->capture_default_str()
        ->in_range(1, 60'000);
    app.add_flag("--json", common.json, "Print JSON documents, one a line");
}

void add_password_option(arguments::App& app, Common& common) {
    app.add_option("--password-file", common.password_file,
                   "A file whose first line is the password that a gateway's port requires for changes")
        ->envname(variable(common, "PASSWORD_FILE"));
}

arguments::App& add_command(arguments::App& app, const std::string& name, const std::string& text) {
    arguments::App& command = *app.add_subcommand(name, text);
    command.fallthrough();
    return command;
}

int run(arguments::App& app, Common& common, int argc, char** argv) {
    host::prepare_streams();
    const arguments::ParseResult outcome = app.parse(argc, argv);
    if (outcome.kind == arguments::ParseResult::Kind::told) return outcome.exit_code;
    if (outcome.kind == arguments::ParseResult::Kind::wrong) {
        // What stands behind the mistake may not have been read.
        common.json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
        fail(common, kUsageOrFile, fmt::format("{} (see {} --help)", outcome.error, common.program));
    }
    return common.exit_code;
}

namespace {

void check_port(const Common& common) {
    if (common.port.empty())
        throw UserError(fmt::format("no port; name one with --port or in the environment's {}",
                                    variable(common, "PORT")));
    // A serial line says by itself what it can; a socket would take anything for the time that messages take.
    const bool socket = host::Endpoint(common.port).is_socket();
    if (socket && std::find(kSpeeds.begin(), kSpeeds.end(), common.baud) == kSpeeds.end())
        throw UserError(fmt::format("--baud {}: no line has that speed; take one of {}", common.baud,
                                    fmt::join(kSpeeds, ", ")));
}

std::unique_ptr<host::ByteClient> client_of(host::ByteClient::Opened opened) {
    if (opened.never) throw UserError(opened.error);
    if (opened.client == nullptr)
        throw mactalk_client::LineError(opened.full ? mactalk_client::LineError::Kind::port_full
                                                    : mactalk_client::LineError::Kind::port_gone,
                                        opened.error);
    return std::move(opened.client);
}

}  // namespace

std::unique_ptr<host::ByteClient> open_port(const Common& common, host::ByteClient::Holding holding) {
    check_port(common);
    return client_of(host::ByteClient::open(common.port, common.baud, holding));
}

host::ByteClient::Opened open_patiently(const std::function<host::ByteClient::Opened()>& open,
                                        base::Instant end, const Waiting& with) {
    constexpr base::Milliseconds kBetweenTries{20};
    bool told = false;
    for (;;) {
        host::ByteClient::Opened opened = open();
        const bool may_heal = !opened.client && (opened.full || opened.absent);
        if (!may_heal || with.now() >= end || !with.goes_on()) return opened;
        if (opened.absent && !told) with.tell();
        told = told || opened.absent;
        with.sleep(kBetweenTries);
    }
}

std::unique_ptr<host::ByteClient> open_for_stop(const Common& common, host::ByteClient::Holding holding) {
    check_port(common);
    const Waiting with{
        .now = host::steady_now,
        .sleep =
            [](base::Microseconds time) {
                std::this_thread::sleep_for(std::chrono::microseconds(time.count()));
            },
        .goes_on = goes_on,
        .tell =
            [&] {
                host::complain(fmt::format("{}: {}: nobody listens there now; waiting {} s for the program",
                                           common.program, common.port, kLongestOpening.count() / 1000));
            }};
    auto opened = open_patiently([&] { return host::ByteClient::open(common.port, common.baud, holding); },
                                 host::steady_now() + kLongestOpening, with);
    if (!opened.client && !opened.never) look_for_interruption();
    return client_of(std::move(opened));
}

void guard(Common& common, const std::function<void()>& what) {
    host::note_interruptions();
    try_to(common, [&] {
        if (common.baud == 0) throw UserError("--baud 0: no line has that speed; 19200 is the motors' own");
        what();
    });
    const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (is_written || !host::output_has_reader()) return;  // `| head -1` has closed the pipe
    host::complain(common.program + ": cannot write to standard output");
    common.exit_code = kUsageOrFile;
}

void tell(const Common& common, const std::string& text, const Json& document) {
    if (common.json) {
        Json whole{{"ok", true}};
        whole.update(document);
        fmt::print("{}\n", one_line(whole));
    } else {
        fmt::print("{}\n", text);
    }
    std::fflush(stdout);
}

void progress(const Common& common, const std::string& text) {
    if (common.json || !host::is_terminal(stderr)) return;
    fmt::print(stderr, "\r\033[K{}", text);
    std::fflush(stderr);
}

bool goes_on() {
    return !host::was_interrupted();
}

bool output_has_reader() {
    return host::output_has_reader();
}

void look_for_interruption() {
    if (!goes_on()) throw mactalk_client::Interrupted("interrupted");
}

std::string one_line(const Json& document) {
    return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nplc::command_line
