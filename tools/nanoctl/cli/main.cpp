#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "cli/subcommands.h"

namespace {

constexpr const char* kFooter =
    "PORT is a serial line's path, pty:PATH, unix:PATH or tcp:127.0.0.1:PORT. It may stand in the "
    "environment's\n"
    "NANOCTL_PORT instead. A program that holds the port already is named.\n"
    "Exit codes: 0 done, 1 the gateway refused or tables differ, 2 wrong usage or a file,\n"
    "3 the port cannot be opened or nobody answers, 130 ended by Ctrl-C or SIGTERM before it was done (watch "
    "and\n"
    "force end with 0). With --json a failure is {\"ok\": false, \"error\": "
    "...}.\n"
    "Example: nanoctl --port /dev/ttyUSB0 upload shuttle.bin --run && nanoctl --port /dev/ttyUSB0 watch";

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// The library says of an unknown command only that there is none.
std::string wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
    const std::string text = one_line(error.what());
    const auto rest = app.remaining(true);
    if (text.find("subcommand is required") == std::string::npos || rest.empty()) return text;
    return fmt::format("'{}' is no command", rest.front());
}

void add_common(CLI::App& app, nplc::nanoctl::cli::Common& common) {
    app.fallthrough();
    app.add_option("--port", common.port, "Where the gateway is")->envname("NANOCTL_PORT");
    app.add_option("--baud", common.baud, "Speed of the line")->capture_default_str();
    app.add_option("--address", common.address, "Address of the gateway")
        ->capture_default_str()
        ->check(CLI::Range(1, 254));
    app.add_option("--patience", common.patience_ms,
                   "Milliseconds beyond the line's time to wait for an answer")
        ->capture_default_str()
        ->check(CLI::Range(1, 60'000));
    app.add_option("--sym", common.symbols, "F.sym of seqc build: names instead of numbers");
    app.add_flag("--json", common.json, "Print JSON documents, one a line");
}

}  // namespace

int main(int argc, char** argv) {
    using namespace nplc::nanoctl::cli;
    CLI::App app("A NanoPLC gateway from a terminal: tables, running, looking on, stepping, settings.",
                 "nanoctl");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("nanoctl ") + NPLC_VERSION);
    app.footer(kFooter);
    Common common;
    add_common(app, common);
    add_transfers(app, common);
    add_controls(app, common);
    add_stepping(app, common);
    add_status(app, common);
    add_break(app, common);
    add_force(app, common);
    add_log(app, common);
    add_settings(app, common);
    add_generated(app, common);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        // What stands behind the mistake may not have been read.
        common.json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
        fail(common, kUsageOrFile, wrong_usage(app, error) + " (see nanoctl --help)");
        return common.exit_code;
    }
    return common.exit_code;
}
