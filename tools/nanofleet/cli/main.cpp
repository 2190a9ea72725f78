#include <chrono>

#include "cli/session.h"
#include "command_line/generated.h"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 a gateway is not as it is wanted, 2 wrong usage or a file, 3 no broker,\n"
    "130 ended by Ctrl-C or SIGTERM before it was done.\n"
    "With --json a failure is {\"ok\": false, \"error\": ...}.\n"
    "Example: nanofleet --fleet hall2.toml status cutters && nanofleet --fleet hall2.toml roll-out cutters "
    "--key plant.key";

template <class Clock>
std::uint64_t milliseconds_of() {
    const auto now = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch());
    return static_cast<std::uint64_t>(now.count());
}

}  // namespace

int main(int argc, char** argv) {
    using namespace nplc::nanofleet::cli;
    nplc::arguments::App app("Tables for many NanoPLC gateways, over the plant's MQTT broker.", "nanofleet");
    app.require_subcommand(1);
    app.fallthrough();
    app.set_version_flag("--version", std::string("nanofleet ") + NPLC_VERSION);
    app.footer(kFooter);
    Common common;
    common.program = "nanofleet";
    common.calendar = milliseconds_of<std::chrono::system_clock>;
    common.steady = milliseconds_of<std::chrono::steady_clock>;
    app.add_option("--fleet", common.fleet, "The list of gateways")
        ->envname("NANOFLEET")
        ->capture_default_str();
    app.add_flag("--json", common.json, "Results as JSON, one document on a line");
    add_keys(app, common);
    add_sign(app, common);
    add_status(app, common);
    add_roll_out(app, common);
    nplc::command_line::add_generated(
        app, common,
        {.version = NPLC_VERSION,
         .title = "tables for many NanoPLC gateways",
         .file_commands = {"sign", "keys public"},
         .file_options = {"--fleet", "--sym", "--proof", "--key", "--table", "--report", "-o", "--output"}});
    return nplc::command_line::run(app, common, argc, argv);
}
