#include "cli/session.h"
#include "command_line/generated.h"

namespace {

constexpr const char* kFooter =
    "PORT is a serial line's path, pty:PATH, unix:PATH or tcp:127.0.0.1:PORT. It may stand in the "
    "environment's\n"
    "NANOCTL_PORT instead. A program that holds the port already is named.\n"
    "Exit codes: 0 done, 1 the gateway refused or tables differ, 2 wrong usage or a file,\n"
    "3 the port cannot be opened or nobody answers, 4 a stop, safe or hold was not confirmed and the "
    "machine\n"
    "may still be running, 130 ended by Ctrl-C or SIGTERM before it was done (watch and force end with 0).\n"
    "With --json a failure is {\"ok\": false, \"error\": "
    "...}.\n"
    "Example: nanoctl --port /dev/ttyUSB0 upload shuttle.bin --run && nanoctl --port /dev/ttyUSB0 watch";

void add_common(nplc::arguments::App& app, nplc::nanoctl::cli::Common& common) {
    nplc::command_line::add_line_options(app, common, "the gateway");
    nplc::command_line::add_password_option(app, common);
    app.add_option("--address", common.address, "Address of the gateway")
        ->capture_default_str()
        ->in_range(1, 254);
    app.add_option("--sym", common.symbols, "F.sym of seqc build: names instead of numbers");
}

}  // namespace

int main(int argc, char** argv) {
    using namespace nplc::nanoctl::cli;
    nplc::arguments::App app(
        "A NanoPLC gateway from a terminal: tables, running, looking on, stepping, settings, set-points.",
        "nanoctl");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("nanoctl ") + NPLC_VERSION);
    app.footer(kFooter);
    Common common;
    common.program = "nanoctl";
    common.address = nplc::nanoctl::gw::kDefaultAddress;
    add_common(app, common);
    add_transfers(app, common);
    add_controls(app, common);
    add_stepping(app, common);
    add_operating(app, common);
    add_status(app, common);
    add_break(app, common);
    add_force(app, common);
    add_log(app, common);
    add_settings(app, common);
    add_set_points(app, common);
    add_firmware(app, common);
    nplc::command_line::add_generated(
        app, common,
        {.version = NPLC_VERSION,
         .title = "a NanoPLC gateway from a terminal",
         .file_commands = {"upload", "verify", "download", "export", "import", "firmware"},
         .file_options = {"--sym", "-o", "--output", "--password-file"}});
    return nplc::command_line::run(app, common, argc, argv);
}
