#include "command_line/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "mactalk_client/master.h"

namespace nplc::command_line {
namespace {

volatile std::sig_atomic_t g_ended = 0;

/// A second signal ends the program at once.
void on_signal(int signal) {
    g_ended = 1;
    std::signal(signal, SIG_DFL);
}

std::string port_variable(const Common& common) {
    std::string name = common.program + "_PORT";
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

std::string without_breaks(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// The library says of an unknown command only that there is none.
std::string wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
    const std::string text = without_breaks(error.what());
    const auto rest = app.remaining(true);
    if (text.find("subcommand is required") == std::string::npos || rest.empty()) return text;
    return fmt::format("'{}' is no command", rest.front());
}

void try_to(Common& common, const std::function<void()>& what) {
    try {
        what();
    } catch (const Failure& failure) {
        fail(common, failure.exit_code(), failure.what(), failure.details());
    } catch (const mactalk_client::LineError& error) {
        fail(common, kNoAnswer, error.what());
    } catch (const mactalk_client::Interrupted& error) {
        fail(common, kInterrupted, error.what());
    } catch (const std::system_error&) {  // of fmt::print; told below
    }
}

}  // namespace

void add_line_options(CLI::App& app, Common& common, const std::string& of_whom) {
    app.fallthrough();
    app.add_option("--port", common.port, fmt::format("Where {} is", of_whom))
        ->envname(port_variable(common));
    app.add_option("--baud", common.baud, "Speed of the line")->capture_default_str();
    app.add_option("--patience", common.patience_ms,
                   "Milliseconds beyond the line's time to wait for an answer")
        ->capture_default_str()
        ->check(CLI::Range(1, 60'000));
    app.add_flag("--json", common.json, "Print JSON documents, one a line");
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& text) {
    CLI::App& command = *app.add_subcommand(name, text);
    command.fallthrough();
    return command;
}

int run(CLI::App& app, Common& common, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        // What stands behind the mistake may not have been read.
        common.json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
        fail(common, kUsageOrFile,
             fmt::format("{} (see {} --help)", wrong_usage(app, error), common.program));
    }
    return common.exit_code;
}

std::unique_ptr<mactalk_client::Wire> open_port(const Common& common) {
    if (common.port.empty())
        throw UserError(
            fmt::format("no port; name one with --port or in the environment's {}", port_variable(common)));
    auto opened = mactalk_client::open_wire(common.port, common.baud);
    if (opened.never) throw UserError(opened.error);
    if (opened.wire == nullptr)
        throw mactalk_client::LineError(mactalk_client::LineError::Kind::port_gone, opened.error);
    return std::move(opened.wire);
}

void guard(Common& common, const std::function<void()>& what) {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
    try_to(common, what);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        fmt::print(stderr, "{}: cannot write to standard output\n", common.program);
        common.exit_code = kUsageOrFile;
    }
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

void fail(Common& common, int exit_code, const std::string& text, const Json& details) {
    common.exit_code = exit_code;
    if (common.json) {
        Json whole{{"ok", false}, {"error", text}};
        whole.update(details);
        fmt::print("{}\n", one_line(whole));
    }
    fmt::print(stderr, "{}: {}\n", common.program, text);
}

bool goes_on() {
    return g_ended == 0;
}

void look_for_interruption() {
    if (!goes_on()) throw mactalk_client::Interrupted("interrupted");
}

std::string one_line(const Json& document) {
    return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nplc::command_line
