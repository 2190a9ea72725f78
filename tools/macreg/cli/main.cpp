#include <fmt/chrono.h>

#include <chrono>

#include "cli/session.h"
#include "command_line/generated.h"
#include "host/byte_client.h"
#include "host/can_client.h"
#include "macreg/midi/values.h"
#include "registers/mac.h"

namespace {

constexpr const char* kFooter =
    "It may stand in the environment's MACREG_PORT instead. A port that another program holds is refused.\n"
    "{}\n"
    "Exit codes: 0 done; 1 the motor refused, or things differ; 2 wrong usage, a file, or not confirmed;\n"
    "3 the port cannot be opened, nobody answers, or the answers ended before it was done;\n"
    "130 ended by Ctrl-C or SIGTERM before it was done (watch ends with 0).\n"
    "With --json a failure is {{\"ok\": false, \"error\": ...}}.\n"
    "Example: macreg --port PORT {}";

std::string footer(const char* address, const char* example) {
    const std::string can = nplc::host::CanClient::forms();
    return fmt::format("PORT is {}{}.\n", nplc::host::ByteClient::forms(),
                       can.empty() ? "" : fmt::format("; for midi also {}", can)) +
           fmt::format(kFooter, address, example);
}

std::string footer_of_motors() {
    return footer("Without --address the only motor on the line is asked for its own.",
                  "get P_IST V_IST MODE_REG");
}

std::string footer_of_modules() {
    return footer("Without --address it is that of a new module: 0, and 1 on CAN.",
                  "midi --model MAC34-1 status");
}

void add_common(nplc::arguments::App& app, nplc::macreg::cli::Common& common) {
    nplc::command_line::add_line_options(app, common, "the motor");
    nplc::command_line::add_password_option(app, common);
    app.add_option("--address", common.address,
                   "Address of the motor, 1 to 254; 255 is every motor on the line")
        ->in_range(1, 255);
    app.add_option("--model", common.model,
                   "MAC50, MAC95, MAC140, MAC141 or MAC800; found out by reading if not said");
    app.add_flag("--yes", common.yes, "Ask nothing: every question is answered with yes");
}

std::vector<std::string> register_names() {
    std::vector<std::string> names;
    for (const auto& reg : nplc::registers::map_of(nplc::registers::Model::mac140))
        names.emplace_back(reg.name);
    return names;
}

nplc::command_line::About about() {
    nplc::command_line::About about{
        .version = NPLC_VERSION,
        .title = "the registers of a MAC motor from a terminal",
        .file_commands = {"load", "diff", "plot", "fit", "midi path"},
        .file_options = {"-o", "--output", "--password-file", "--picture", "--response", "--against"}};
    for (const char* command : {"get", "list", "record", "set", "watch"})
        about.words[command] = register_names();
    for (const auto& parameter : nplc::macreg::midi::parameters()) {
        about.words["midi get"].emplace_back(parameter.name);
        if (parameter.command) about.words["midi set"].emplace_back(parameter.name);
    }
    for (const char* command : {"midi power", "midi reference"}) about.words[command] = {"on", "off"};
    return about;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace nplc::macreg::cli;
    nplc::arguments::App app(
        "The registers of a MAC motor from a terminal: read, set, watch, save, compare, and why it does not "
        "move.",
        "macreg");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("macreg ") + NPLC_VERSION);
    app.footer(footer_of_motors());  // a command copies it from here when it is added
    Common common;
    common.program = "macreg";
    common.date =
        fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                    fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
    add_common(app, common);
    add_list(app, common);
    add_get(app, common);
    add_set(app, common);
    add_watch(app, common);
    add_why(app, common);
    add_dump(app, common);
    add_load(app, common);
    add_diff(app, common);
    add_service(app, common);
    add_find(app, common);
    add_record(app, common);
    add_samples(app, common);
    add_plot(app, common);
    add_fit(app, common);
    add_monitor(app, common);
    add_ui(app, common);
    app.footer(footer_of_modules());
    add_midi(app, common);
    app.footer(footer_of_motors());
    nplc::command_line::add_generated(app, common, about());
    return nplc::command_line::run(app, common, argc, argv);
}
