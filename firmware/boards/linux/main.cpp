#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "arguments/arguments.h"
#include "axis_store.h"
#include "command_line/generated.h"
#include "config.h"
#include "exit_codes.h"
#include "host/printable.h"
#include "host/text_file.h"
#include "plant_part.h"
#include "service.h"
#include "slow_adapters.h"
#include "stored.h"
#include "wiring.h"

namespace {

using namespace nplc;
using namespace nplc::boards;

constexpr const char* kFooter =
    "Runs the sequences of one or more JVL MAC motors or MIDI Ingenierie MAC23 and MAC34 drives on this "
    "board until\n"
    "SIGTERM or SIGINT: then outputs get their safe levels and the motors are told to stop. The "
    "configuration names,\n"
    "for each axis, the motor's serial port or CAN bus, the GPIO lines, the user's port and the first "
    "settings; the\n"
    "example that comes with the program documents all of it. A table is uploaded with `nanoctl --port PORT "
    "upload FILE`\n"
    "and kept; whatever is wrong is said on standard error, in the journal with its level. An axis that "
    "lacks\n"
    "something, or whose table cannot run, is stopped with its outputs safe and its port open; the others go "
    "on.\n"
    "check-config looks at the devices too, and at the settings and tables that are stored.\n"
    "Exit codes: 0 ended in order, or all is in order; 2 wrong usage, or mistakes in the configuration; 3 "
    "the\n"
    "watchdog could not be had, check-config found what an axis cannot have or run, or note-end a service "
    "that runs.\n"
    "Example: nanoplc check-config /etc/nanoplc/nanoplc.toml && nanoplc --config /etc/nanoplc/nanoplc.toml";

/// More than eight axes need.
constexpr std::size_t kMostOfAConfig = std::size_t{1} << 20U;

struct Options {
    std::string config = "/etc/nanoplc/nanoplc.toml";
    std::string file;
    bool no_devices = false;
    bool keys = false;
    bool markdown = false;
};

struct Loaded {
    Config config;
    std::set<std::string> keys{};
    bool is_whole = false;
};

void print(const std::string& file, const std::vector<Mistake>& mistakes) {
    for (const Mistake& mistake : mistakes) {
        const std::string key = mistake.key.empty() ? "" : mistake.key + ": ";
        host::complain(fmt::format("{}:{}: {}{}", file, mistake.line, key, mistake.text));
    }
}

Loaded load(const std::string& file) {
    const host::FileContent content = host::read_text(file, kMostOfAConfig);
    if (!content.problem.empty()) {
        host::complain(
            fmt::format("{}: cannot be read: {}; name a configuration with --config", file, content.problem));
        return {};
    }
    ReadConfig read = read_config(content.bytes);
    print(file, read.findings.mistakes);
    return {std::move(read.config), std::move(read.findings.keys), read.findings.mistakes.empty()};
}

int run_service(const std::string& file) {
    const Loaded loaded = load(file);
    if (!loaded.is_whole) return kWrong;
    Journal journal(loaded.config.log_level);
    return Service(loaded.config, journal).run();
}

/// Devices missing on this machine, and faults in the stored data.
StoredFindings look_around(const Config& config) {
    StoredFindings found = look_at_stored(config);
    std::vector<Mistake>& troubles = found.troubles;
    const auto missing = missing_devices(config);
    troubles.insert(troubles.end(), missing.begin(), missing.end());
    std::stable_sort(troubles.begin(), troubles.end(),
                     [](const Mistake& a, const Mistake& b) { return a.line < b.line; });
    return found;
}

/// Whatever is missing: what an engineer has to open in the plant's network.
void print_what_is_there(const Options& options, const Config& config,
                         const std::vector<std::string>& notes) {
    std::vector<Mistake> warnings = options.no_devices ? std::vector<Mistake>{} : slow_adapters(config);
    for (auto* more : {plant_warnings, port_warnings}) {
        for (const Mistake& warning : more(config)) warnings.push_back(warning);
    }
    for (Mistake& warning : warnings) warning.text = "warning: " + warning.text;
    print(options.file, warnings);
    for (const std::string& note : notes) fmt::print("{}\n", note);
    for (const std::string& line : faces_in_words(config)) fmt::print("{}\n", line);
    for (const std::string& line : closed_doors(config)) fmt::print("{}\n", line);
    std::fflush(stdout);
}

int check(const Options& options) {
    const Loaded loaded = load(options.file);
    const StoredFindings found = options.no_devices ? StoredFindings{} : look_around(loaded.config);
    if (loaded.is_whole && !options.keys) print_what_is_there(options, loaded.config, found.notes);
    print(options.file, found.troubles);
    if (!loaded.is_whole) return kWrong;
    if (!found.troubles.empty()) return kNoDevice;
    if (options.keys) {
        fmt::print("{}\n", fmt::join(loaded.keys, "\n"));
        return kDone;
    }
    const std::size_t axes = loaded.config.axes.size();
    fmt::print("{}: in order, {} {}\n", options.file, axes, axes == 1 ? "axis" : "axes");
    return kDone;
}

/// The folder of one; empty: none. A program that was killed may hold its store for a moment.
std::string store_in_use(const Config& config) {
    constexpr int kLooks = 20;
    constexpr std::chrono::milliseconds kBetweenLooks{50};
    std::string used;
    for (int i = 0; i < kLooks; ++i) {
        if (i != 0) std::this_thread::sleep_for(kBetweenLooks);
        used.clear();
        for (const AxisConfig& axis : config.axes) {
            const std::string folder = config.state_directory + "/" + axis.name;
            if (is_in_use(folder)) used = folder;
        }
        if (used.empty()) break;
    }
    return used;
}

/// To be called at each end of the service, orderly or not.
int note_ends(const std::string& file) {
    const Loaded loaded = load(file);
    if (!loaded.is_whole) return kWrong;
    if (const std::string used = store_in_use(loaded.config); !used.empty()) {
        host::complain(fmt::format(
            "{}: a service uses this store: it has not ended, and nothing was noted of any axis", used));
        return kNoDevice;
    }
    int outcome = kDone;
    for (const AxisConfig& axis : loaded.config.axes) {
        const std::string error = note_crash(loaded.config.state_directory + "/" + axis.name);
        if (error.empty()) continue;
        host::complain(error);
        outcome = kNoDevice;
    }
    return outcome;
}

int print_wiring(const std::string& file) {
    const Loaded loaded = load(file);
    if (!loaded.is_whole) return kWrong;
    fmt::print("{}", wiring(loaded.config));
    return kDone;
}

int print_modbus_map(const std::string& file, bool markdown) {
    faces::Scaling scaling;
    registers::Model model = registers::Model::mac140;
    if (!file.empty()) {
        const Loaded loaded = load(file);
        if (!loaded.is_whole) return kWrong;
        const AxisConfig& axis = loaded.config.axes.front();
        scaling = axis.scaling;
        const bool is_800 = axis.settings.get(store::Setting::motor_is_mac800) != 0;
        if (is_800) model = registers::Model::mac800;
    }
    fmt::print("{}", markdown ? modbus::map_as_markdown() : modbus::map_as_csv(scaling, model));
    return kDone;
}

}  // namespace

int main(int argc, char** argv) {
    arguments::App app("The gateway firmware on a Linux board.", "nanoplc");
    Options options;
    app.fallthrough();
    app.set_version_flag("--version", std::string("nanoplc ") + NPLC_VERSION);
    app.footer(kFooter);
    app.add_option("--config", options.config, "The configuration")->capture_default_str()->type_name("FILE");
    arguments::App& check_config = *app.add_subcommand(
        "check-config", "Name every mistake in a configuration and in what is stored, and end");
    check_config.add_option("file", options.file, "The configuration")->required();
    check_config.add_flag("--no-devices", options.no_devices,
                          "Of another machine: look for no device and no store");
    check_config.add_flag("--keys", options.keys, "Print every key that may stand in it");
    arguments::App& modbus_map =
        *app.add_subcommand("modbus-map", "Print the map of the Modbus server as CSV, for a PLC's tools");
    modbus_map.add_option("file", options.file, "The configuration, for its first axis's unit and motor");
    modbus_map.add_flag("--markdown", options.markdown,
                        "A table for documents, without the motor's registers");
    app.add_subcommand("wiring", "Print the wiring, a row for each terminal")
        ->add_option("file", options.file, "The configuration")
        ->required();
    app.add_subcommand("note-end", "After the end of the service: write down which axes have crashed")
        ->add_option("file", options.file, "The configuration")
        ->required();
    command_line::Common common;
    common.program = "nanoplc";
    command_line::add_generated(app, common,
                                {.version = NPLC_VERSION,
                                 .title = "the gateway firmware on a Linux board",
                                 .section = 8,
                                 .file_commands = {"check-config", "modbus-map", "note-end", "wiring"},
                                 .file_options = {"--config"}});
    const arguments::ParseResult outcome = app.parse(argc, argv);
    if (outcome.kind == arguments::ParseResult::Kind::told) return outcome.exit_code;
    if (outcome.kind == arguments::ParseResult::Kind::wrong) {
        host::complain(fmt::format("nanoplc: {} (see nanoplc --help)", outcome.error));
        return kWrong;
    }
    if (app.got_subcommand("check-config")) return check(options);
    if (app.got_subcommand("modbus-map")) return print_modbus_map(options.file, options.markdown);
    if (app.got_subcommand("note-end")) return note_ends(options.file);
    if (app.got_subcommand("wiring")) return print_wiring(options.file);
    if (app.got_subcommand("completion") || app.got_subcommand("man")) return common.exit_code;
    return run_service(options.config);
}
