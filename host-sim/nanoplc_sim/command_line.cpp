#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "arguments/arguments.h"
#include "arguments/pages.h"
#include "input_file.h"
#include "listed.h"
#include "store/settings.h"

namespace nplc::sim {
namespace {

constexpr const char* kExitCodes =
    "Exit code: 0 all is well, 1 an expectation of the scenario failed, 2 a mistake in the command line or "
    "in a file.";
constexpr const char* kUnits = "Times are written 500ms, 5s, 2min; shares 1%, 0.5%.";

/// An option whose text is read by `read`, which returns false for an invalid text.
void add_read(arguments::App& app, const std::string& name, const std::string& type, const std::string& help,
              const std::string& wanted, std::function<bool(const std::string&)> read) {
    app.add_option_function(
           name,
           [name, wanted, read = std::move(read)](const std::string& text) {
               if (read(text)) return;
               throw InputError(fmt::format("{} \"{}\": write {}", name, text, wanted));
           },
           help)
        ->type_name(type);
}

template <class Target>
std::function<bool(const std::string&)> into(Target& target, auto parse) {
    return [&target, parse](const std::string& text) {
        const auto value = parse(text);
        if (value) target = *value;
        return value.has_value();
    };
}

template <class Number>
std::optional<Number> whole(const std::string& text, std::int64_t min, std::int64_t max) {
    const auto value = parse_integer(text);
    if (!value || *value < min || *value > max) return std::nullopt;
    return static_cast<Number>(*value);
}

/// `1%` or `1%:5ms`
bool parse_delay(const std::string& text, LineFaults& faults) {
    const auto colon = text.find(':');
    const auto share = parse_percent(text.substr(0, colon));
    if (!share) return false;
    faults.delay = *share;
    if (colon == std::string::npos) return true;
    const auto longest = parse_duration(text.substr(colon + 1));
    if (longest) faults.longest_delay = *longest;
    return longest.has_value();
}

void add_line_options(arguments::App& app, RunOptions& options) {
    const std::string share = "a share, such as 1%";
    add_read(app, "--baud", "RATE", "rate of the line to the motor (19200; 38400 with a MIDI drive)",
             "a standard rate, 1200 to 921600",
             into(options.baud, [](const std::string& text) -> std::optional<std::uint32_t> {
                 const auto baud = whole<std::uint32_t>(text, 0, UINT32_MAX);
                 if (!baud || !registers::gateway::is_standard_rate(*baud)) return std::nullopt;
                 return baud;
             }));
    add_read(app, "--seed", "N", "seed of the line's faults (1)", "a whole number 0 to 4294967295",
             into(options.seed,
                  [](const std::string& text) { return whole<std::uint64_t>(text, 0, UINT32_MAX); }));
    add_read(app, "--drop", "SHARE", "characters that are lost, both directions", share,
             into(options.faults.drop, parse_percent));
    add_read(app, "--damage", "SHARE", "characters that arrive changed", share,
             into(options.faults.damage, parse_percent));
    add_read(app, "--framing", "SHARE", "characters that arrive with a framing error", share,
             into(options.faults.framing, parse_percent));
    add_read(app, "--delay", "SHARE[:TIME]", "characters that arrive late, by up to TIME (5ms)",
             "a share and perhaps a time, such as 1% or 1%:5ms",
             [&options](const std::string& text) { return parse_delay(text, options.faults); });
}

/// "MAC50, MAC800, or of MIDI MAC23 or MAC34-1"
std::string all_models() {
    std::string text;
    for (const registers::DriveFamily* family : registers::families()) {
        std::vector<std::string_view> names;
        for (const registers::DriveModel& model : family->models()) names.push_back(model.name);
        if (text.empty())
            text = fmt::format("{}", fmt::join(names, ", "));
        else
            text += fmt::format(", or of {} {}", family->name(), listed(names));
    }
    return text;
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const registers::DriveFamily* family : registers::families()) {
        for (const registers::DriveModel& model : family->models()) names.emplace_back(model.name);
    }
    return names;
}

/// Options for outside programs.
void add_doors(arguments::App& app, RunOptions& options) {
    app.add_option(
           "--mactalk", options.mactalk,
           "open the gateway's MacTalk port: pty:PATH, unix:PATH or tcp:127.0.0.1:PORT; with --realtime")
        ->type_name("EP");
    app.add_option("--panel", options.panel,
                   "serve the panel, a page for a browser: 127.0.0.1:PORT (0: any); with --realtime")
        ->type_name("ADDRESS:PORT");
    app.add_option("--modbus", options.modbus,
                   "serve a PLC by Modbus TCP: tcp:127.0.0.1:PORT, or by RTU, 19200 baud, 8E1, unit 1: "
                   "rtu:/dev/ttyUSB0 or pty:PATH; with --realtime. `nanoplc modbus-map` prints the map")
        ->type_name("EP");
    app.add_option("--mqtt", options.mqtt,
                   "show the axis to a broker as Sparkplug B's node nanoplc/sim: HOST:PORT; with --realtime")
        ->type_name("HOST:PORT");
    app.add_option("--metrics", options.metrics,
                   "serve metrics for Prometheus: 127.0.0.1:PORT; with --realtime")
        ->type_name("ADDRESS:PORT");
}

/// Options for the gateway's environment.
void add_world(arguments::App& app, RunOptions& options) {
    app.add_option("--scenario", options.scenario,
                   "inputs, line faults and expectations, see host-sim/scenario")
        ->type_name("S.scn");
    app.add_option("--inputs", options.inputs,
                   "inputs that are on from the beginning, by name or as IN0..IN5: Well,Guard (of an input "
                   "declared AT NOT IN2, IN2 switches the terminal on)")
        ->delimiter(',')
        ->type_name("NAMES");
    app.add_option("--plant", options.plant,
                   "inertia, friction and load of a real axis, as `macreg fit` writes them")
        ->type_name("axis.toml");
}

void add_run(arguments::App& parent, RunOptions& options) {
    arguments::App& app = *parent.add_subcommand(
        "run", "Run a sequence on the simulated gateway with a virtual motor; prints a timeline");
    app.add_option("program", options.program,
                   "F.seq (compiled on the way), or a table: F.bin or F.hex; "
                   "without it the table in the flash");
    app.add_option("--symbols", options.symbols,
                   "names for a table (F.sym beside F.bin, as `seqc build` writes it, if it fits)")
        ->type_name("F.sym");
    add_world(app, options);
    add_read(app, "--for", "TIME", "end after this time (10s without a scenario; no end with --realtime)",
             "a time, such as 500ms, 5s or 2min", into(options.length, [](const std::string& text) {
                 const auto time = parse_duration(text);
                 return time && *time > Time{0} ? time : std::nullopt;
             }));
    app.add_option("--trace", options.csv, "write a trace as CSV")->type_name("T.csv");
    app.add_option("--vcd", options.vcd, "write a trace as VCD, for GTKWave")->type_name("T.vcd");
    app.add_option("--junit", options.junit, "write the scenario's expectations as JUnit's XML")
        ->type_name("T.xml");
    add_read(app, "--motor", "MODEL", "the motor (the program's own; MAC140 for a table without names)",
             all_models(), [&options](const std::string& text) {
                 const registers::DriveModel* model = registers::find_drive(text);
                 if (model == nullptr) return false;
                 options.motor.reset();
                 options.drive = nullptr;
                 if (model->family->is_translated())
                     options.drive = model;
                 else
                     options.motor = model->map;
                 return true;
             });
    add_read(app, "--midi", "LINE", "line to a MIDI drive: v24 or can (v24)", "v24 or can",
             into(options.can, [](const std::string& text) -> std::optional<bool> {
                 if (text != "v24" && text != "can") return std::nullopt;
                 return text == "can";
             }));
    app.add_flag("--realtime", options.realtime, "wall-clock time; keys 0-5 toggle inputs, q ends");
    add_doors(app, options);
    app.add_option("--flash", options.flash, "file that keeps the gateway's flash: stored table and settings")
        ->type_name("FILE");
    app.add_flag("--quiet", options.quiet, "only the summary");
    app.add_flag("--rapid", options.rapid, "rapid communication with the motor in place of safe");
    app.add_flag("--old-codes", options.old_register_codes, "the older register codes, driver and motor");
    app.add_flag("--keep-motor", options.keep_motor, "do not stop the motor before the first scan");
    app.add_flag("--new", options.is_new, "as a board with a new store: it waits for a first run command");
    add_read(app, "--debounce", "TIME", "of the inputs (3ms)", "a time up to 1s, such as 3ms",
             into(options.debounce, [](const std::string& text) {
                 const auto time = parse_duration(text);
                 return time && *time <= std::chrono::seconds{1} ? time : std::nullopt;
             }));
    add_line_options(app, options);
    app.footer(fmt::format("{}\n{}", kUnits, kExitCodes));
}

void add_scan(arguments::App& parent, ScanOptions& options) {
    arguments::App& app =
        *parent.add_subcommand("scan", "Run the sequence engine alone, one scan a row; prints CSV");
    app.add_option("table", options.table,
                   "F.bin or F.hex: terms of 8 bytes, ended by one whose STATE is 3Fh")
        ->required();
    app.add_option("--stimulus", options.stimulus,
                   "CSV with the header dt_ms,inputs,inpos,error; - is standard input")
        ->type_name("S.csv")
        ->required();
    app.footer(fmt::format(
        "Prints scan,step,timer,counter,outputs,fastmac,flexmac: scans count from 1, all values as "
        "they stand after\nthe scan and after dt_ms was taken off the timer.\n{}",
        kExitCodes));
}

void add_fmu(arguments::App& parent, FmuCommand& command) {
    arguments::App& app = *parent.add_subcommand(
        "fmu", "Write a virtual motor, or a gateway and its motor, as an FMU for other simulators");
    app.add_option("-o,--output", command.output, "the FMU, such as motor.fmu")
        ->type_name("F.fmu")
        ->required();
    app.add_option(
           "--with-gateway", command.program,
           "a gateway that runs this program, F.seq, F.bin or F.hex; without it the motor alone, whose "
           "registers the importer writes")
        ->type_name("PROGRAM");
    app.add_option("--symbols", command.symbols, "names for a table, as of run")->type_name("F.sym");
    add_read(app, "--motor,--model", "MODEL", "the motor (the program's own; MAC140 without one)",
             "a JVL motor: MAC50, MAC95, MAC140, MAC141 or MAC800",
             into(command.motor, [](const std::string& text) { return registers::model_of(text); }));
    add_read(app, "--fmi", "VERSION", "of the standard: 3 (FMI 3.0) or 2 (FMI 2.0)", "3 or 2",
             into(command.fmi, [](const std::string& text) { return whole<int>(text, 2, 3); }));
    app.add_option("--plant", command.plant,
                   "inertia, friction and load of a real axis, as `macreg fit` writes them: where the FMU's "
                   "parameters begin")
        ->type_name("axis.toml");
    app.add_option("--windows", command.windows,
                   "a library for Windows to put in too, as `tools/portable windows` builds it")
        ->type_name("F.dll");
    app.footer(fmt::format("Variables, units and times: host-sim/fmu/README.md.\n{}", kExitCodes));
}

void check_run(const RunOptions& run) {
    if (run.mactalk && !run.realtime)
        throw InputError("nanoplc-sim: --mactalk needs --realtime: outside programs live in real time");
    if (run.panel && !run.realtime)
        throw InputError("nanoplc-sim: --panel needs --realtime: a browser cannot follow virtual time");
    if (run.modbus && !run.realtime)
        throw InputError("nanoplc-sim: --modbus needs --realtime: outside programs live in real time");
    if (run.metrics && !run.realtime)
        throw InputError("nanoplc-sim: --metrics needs --realtime: outside programs live in real time");
    if (run.mqtt && !run.realtime)
        throw InputError("nanoplc-sim: --mqtt needs --realtime: outside programs live in real time");
    if (run.program.empty() && !run.flash && !run.mactalk && !run.panel && !run.modbus)
        throw InputError(
            "nanoplc-sim: run what? name a program, or --flash, --mactalk, --panel or --modbus; see "
            "nanoplc-sim --help");
    if (run.junit && !run.scenario)
        throw InputError(
            "nanoplc-sim: --junit without a scenario, whose expectations it writes; add --scenario S.scn");
    if (run.program.empty() && run.symbols)
        throw InputError("nanoplc-sim: --symbols without a table; name the table that they are for");
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    arguments::App app("The NanoPLC gateway's firmware on a simulated board, and its sequence engine alone",
                       "nanoplc-sim");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("nanoplc-sim ") + NPLC_VERSION);
    app.footer(kExitCodes);
    RunOptions run;
    ScanOptions scan;
    add_run(app, run);
    FmuCommand fmu;
    add_scan(app, scan);
    add_fmu(app, fmu);
    std::string page;
    arguments::add_pages(
        app,
        {.version = NPLC_VERSION,
         .title = "the NanoPLC gateway's firmware on a simulated board",
         .file_commands = {"run", "scan"},
         .file_options = {"--symbols", "--scenario", "--plant", "--trace", "--vcd", "--junit", "--flash",
                          "--stimulus", "-o", "--output", "--with-gateway", "--windows"},
         .option_words = {{"--motor", model_names()}, {"--midi", {"v24", "can"}}, {"--fmi", {"3", "2"}}}},
        [&page](const std::string& text) { page = text; });
    const arguments::ParseResult outcome = app.parse(argc, argv);
    if (outcome.kind == arguments::ParseResult::Kind::told) return NothingToDo{};
    if (outcome.kind == arguments::ParseResult::Kind::wrong)
        throw InputError(fmt::format("nanoplc-sim: {} (see nanoplc-sim --help)", outcome.error));
    if (!page.empty()) return Page{page};
    if (app.got_subcommand("scan")) return scan;
    if (app.got_subcommand("fmu")) return fmu;
    check_run(run);
    return run;
}

}  // namespace nplc::sim
