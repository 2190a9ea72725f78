#include "run_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/printable.h"
#include "host/terminal.h"
#include "input_file.h"
#include "listed.h"
#include "outside.h"
#include "program.h"
#include "session.h"
#include "sim/output_file.h"

namespace nplc::sim {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return true;
    const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
    if (error) return false;
    const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
    return !error && whole_a == whole_b;
}

bool touches(const std::vector<fs::path>& written, const fs::path& file) {
    return std::any_of(written.begin(), written.end(),
                       [&](const fs::path& path) { return same_file(path, file); });
}

struct Output {
    std::string option;
    const std::string& path;

    void check_against(const std::string& input, std::string_view what) const {
        if (!touches(OutputFile::written_for(path), input)) return;
        throw InputError(fmt::format("{} {}: this would overwrite the {} {}; name another file", option, path,
                                     what, input));
    }
    void check_against(const Output& other) const {
        const auto ours = OutputFile::written_for(path);
        const auto theirs = OutputFile::written_for(other.path);
        const auto is_ours = [&](const fs::path& file) { return touches(ours, file); };
        if (!std::any_of(theirs.begin(), theirs.end(), is_ours)) return;
        throw InputError(fmt::format("{} {} and {} {}: one would overwrite the other; name two files", option,
                                     path, other.option, other.path));
    }
};

void check(const Output& output, const RunOptions& options) {
    if (output.path.empty() || output.path == "-") {
        throw InputError(
            fmt::format("{} \"{}\": this is no file's name; write one, or /dev/stdout for standard output",
                        output.option, output.path));
    }
    if (options.flash) output.check_against(*options.flash, "flash file");
    if (options.program.empty()) return;
    output.check_against(options.program, "program");
    const std::string symbols = symbols_of(options.program, options.symbols);
    if (!symbols.empty()) output.check_against(symbols, "symbol file");
    if (options.scenario) output.check_against(*options.scenario, "scenario");
}

using Clock = std::chrono::steady_clock;

constexpr Time kSlice = std::chrono::milliseconds{50};
constexpr auto kRefresh = std::chrono::milliseconds{100};

Scenario load_scenario(const RunOptions& options, const Names& names) {
    if (!options.scenario) return {};
    const std::string& file = *options.scenario;
    ParsedScenario parsed = parse_scenario(read_input(file, "a scenario"), file, names);
    if (!parsed.mistakes.empty()) throw InputError(in_words(file, parsed.mistakes));
    if (!parsed.scenario.can_end() && !options.length && !options.realtime) {
        throw InputError(
            fmt::format("{}: the scenario has no end; write such as `end at 10 s`, or use --for 10s", file));
    }
    return std::move(parsed.scenario);
}

bool wants_colour() {
    return host::is_terminal(stdout) && std::getenv("NO_COLOR") == nullptr;
}

/// A line on standard error that is rewritten in place; only if nothing else writes to the terminal.
class Progress {
  public:
    explicit Progress(bool on) : on_(on) {}
    ~Progress() {
        if (shown_) fmt::print(stderr, "\r\033[K");
    }
    void show(const Session& session) {
        if (!on_ || Clock::now() < next_) return;
        next_ = Clock::now() + kRefresh;
        shown_ = true;
        const std::string of = session.length() ? " of " + in_words(*session.length()) : "";
        fmt::print(stderr, "\r\033[K{:.1f} s{} of virtual time",
                   static_cast<double>(session.now().count()) / 1e9, of);
        std::fflush(stderr);
    }

  private:
    bool on_;
    bool shown_ = false;
    Clock::time_point next_ = Clock::now() + kRefresh;
};

void run_fast(Session& session, const RunOptions& options, const volatile std::sig_atomic_t& interrupted) {
    Progress progress(host::is_terminal(stderr) && (options.quiet || !host::is_terminal(stdout)));
    while (!session.ended() && interrupted == 0) {
        session.advance(session.now() + kSlice);
        progress.show(session);
    }
}

void check_drive(const RunOptions& run) {
    if (run.can && run.drive == nullptr)
        throw InputError("nanoplc-sim: --midi without a MIDI drive; add --motor MAC23, MAC34-1 or MAC34-2");
    if (run.drive == nullptr) return;
    if (run.plant)
        throw InputError("nanoplc-sim: --plant is of a JVL motor's shaft; leave it out with a MIDI drive");
    const auto bauds = run.drive->family->bauds();
    if (run.can.value_or(false)) {
        if (!run.drive->has_can)
            throw InputError(
                fmt::format("nanoplc-sim: a {} has no CAN; leave out --midi can", run.drive->name));
        if (run.baud)
            throw InputError("nanoplc-sim: --baud is of a serial line; leave it out with --midi can");
    } else if (run.baud && !bauds.empty() &&
               std::find(bauds.begin(), bauds.end(), *run.baud) == bauds.end()) {
        throw InputError(fmt::format("nanoplc-sim: a {} drive's line has {} baud", run.drive->family->name(),
                                     listed(bauds)));
    }
    if (run.rapid || run.old_register_codes)
        throw InputError("nanoplc-sim: --rapid and --old-codes are of a JVL motor's line; leave them out");
}

/// What the program was compiled for and what it runs on, where these differ; empty where they do not.
std::string misfit(const RunOptions& options, const Program& program) {
    const bool another_drive =
        program.drive != nullptr && program.drive != options.drive &&
        (options.drive == nullptr || program.drive->program_name != options.drive->program_name);
    const bool another_motor = program.drive == nullptr && options.motor &&
                               *options.motor != program.names.motor && !program.names.steps.empty();
    if (!another_drive && !another_motor) return {};
    return fmt::format(
        "{}: was compiled for {} and runs on {}; its register values may not fit", program.file,
        another_drive ? program.drive->program_name : registers::name_of(program.names.motor),
        options.drive != nullptr ? options.drive->name
                                 : registers::name_of(options.motor.value_or(program.names.motor)));
}

Program stored_program() {
    Program program;
    program.file = "the stored table";
    return program;
}

/// To be called before anything is written: no output may overwrite one of the run's inputs or another
/// output, under any name. Throws InputError.
void check_outputs(const RunOptions& options) {
    std::vector<Output> outputs;
    const std::string symbols = symbols_beside_trace(options);
    if (options.csv) outputs.push_back({"--trace", *options.csv});
    if (!symbols.empty()) outputs.push_back({"the symbols of --trace,", symbols});
    if (options.vcd) outputs.push_back({"--vcd", *options.vcd});
    if (options.junit) outputs.push_back({"--junit", *options.junit});
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        check(outputs[i], options);
        for (std::size_t j = 0; j < i; ++j) outputs[j].check_against(outputs[i]);
    }
}

}  // namespace

std::string symbols_beside_trace(const RunOptions& options) {
    if (!options.csv || OutputFile::written_for(*options.csv).empty()) return {};
    const std::string beside = *options.csv + ".sym";
    const std::string own =
        options.program.empty() ? std::string() : symbols_of(options.program, options.symbols);
    return !own.empty() && touches(OutputFile::written_for(beside), own) ? std::string() : beside;
}

int run(const RunOptions& given, const volatile std::sig_atomic_t& interrupted) {
    check_outputs(given);
    Program program = given.program.empty() ? stored_program() : load_program(given.program, given.symbols);
    RunOptions options = given;
    if (!options.motor && options.drive == nullptr) options.drive = program.drive;
    check_drive(options);
    if (!program.nameless.empty()) host::complain(program.nameless);
    if (const std::string text = misfit(options, program); !text.empty()) host::complain(text);
    if (options.motor) program.names.motor = *options.motor;
    program.names.drive = options.drive;
    if (options.drive != nullptr && program.names.motor == registers::Model::mac800)
        throw InputError(
            fmt::format("{}: is for a MAC800, whose registers a {} drive does not have; write it "
                        "for MAC140",
                        program.file, options.drive->family->name()));
    const Scenario scenario = load_scenario(options, program.names);
    if (!program.remark.empty()) host::complain(program.remark);
    const auto outside = open_outside(options, program);
    const std::size_t columns = host::is_terminal(stdout) ? host::terminal_columns() : 0;
    Session session(options, program, scenario, Palette(wants_colour()), columns, outside->flash());
    session.heading();
    fmt::print(stderr, "{}", session.doubts());
    if (options.realtime) {
        outside->run(session, interrupted);
    } else {
        run_fast(session, options, interrupted);
    }
    return session.finish() ? 0 : 1;
}

}  // namespace nplc::sim
