#include "verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/input.h"
#include "cli/json.h"
#include "cli/junit.h"
#include "cli/subcommands.h"
#include "cli/verify_emit.h"
#include "cli/verify_proof.h"
#include "sequencer/table.h"
#include "verify/story.h"
#include "views/line_time.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Assume;
using verify::Verdict;

constexpr int kBroken = 1;
constexpr int kUndecided = 4;

struct VerifyArguments {
    InputFile table;
    std::string properties;
    std::string assume = "driver";
    std::string stimulus;
    std::string scenario;
    std::string junit;
    std::string emit;
    std::string output;
    std::string proof;
    bool json = false;
};

verify::Names names_for(const Input& input) {
    verify::Names names;
    if (!input.symbols) return names;
    names.steps = input.symbols->steps;
    names.inputs = input.symbols->inputs;
    names.outputs = input.symbols->outputs;
    return names;
}

constexpr std::uint32_t kBaud = 19'200;

/// On a line without faults, with the polls of driver and gateway.
std::uint32_t most_time(std::span<const sequencer::MotorOrder> orders) {
    const LineUse use = line_use(orders, true);
    return static_cast<std::uint32_t>(std::ceil(milliseconds(use.at_most, kBaud))) + use.messages +
           verify::Machine::kMostIdle;
}

/// As `seqc report` works it out. The motor's queue takes eight orders beside the one under way; a scan with
/// more waits for those before. What a drive whose orders are translated takes is known only as the longest
/// that a gateway waits.
verify::Delay order_time(std::span<const sequencer::MotorOrder> orders, bool translated) {
    constexpr std::size_t kQueue = 8;
    constexpr std::uint32_t kLongestWait = 1'000;
    const bool waits = orders.size() > kQueue;
    if (translated) return {0, kLongestWait, waits ? kLongestWait : 0};
    const LineUse use = line_use(orders, true);
    return {static_cast<std::uint32_t>(milliseconds(use.until_done, kBaud)), most_time(orders),
            waits ? most_time(orders.first(orders.size() - kQueue)) : 0};
}

/// The properties of a program, at their lines.
verify::PropertyReading properties_in(const Input& input, const verify::Names& names) {
    if (!input.program) return {};
    std::string text = input.source;
    std::size_t at = 0;
    const auto blank = [&](std::size_t end) {
        for (; at < end; ++at) {
            if (text[at] != '\n') text[at] = ' ';
        }
    };
    for (const Span& span : input.program->properties) {
        blank(span.offset);
        at = span.offset + span.length;
    }
    blank(text.size());
    return verify::read_properties(text, names);
}

const char* word_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::proved:
            return "proved";
        case Verdict::broken:
            return "broken";
        case Verdict::undecided:
            return "undecided";
    }
    return "";
}

int exit_code_of(const verify::Report& report) {
    const auto any = [&](Verdict verdict) {
        return std::any_of(report.results.begin(), report.results.end(), [&](const verify::Result& r) {
            return r.verdict == verdict && r.severity == verify::Severity::fault;
        });
    };
    if (any(Verdict::broken)) return kBroken;
    return any(Verdict::undecided) ? kUndecided : kOk;
}

Json course_object(const verify::Course& course, const verify::Names& names) {
    Json scans = Json::array();
    for (const verify::PlayedScan& scan : course) {
        Json& added = scans.emplace_back();
        added["inputs"] = scan.image & sequencer::kInputsMask;
        added["inpos"] = (scan.image & sequencer::kInPos) != 0 ? 1 : 0;
        added["error"] = (scan.image & sequencer::kError) != 0 ? 1 : 0;
        added["dt_ms"] = scan.dt_ms;
        added["step"] = verify::step_name(names, scan.after.step);
        added["outputs"] = scan.after.outputs;
    }
    return scans;
}

Json document_of(const verify::Report& report, const VerifyArguments& options, const Input& input,
                 const verify::Names& names) {
    Json document;
    document["file"] = options.table.file;
    document["assume"] = options.assume;
    document["assumptions"] = Json::array();
    for (const verify::Assumption& assumption : report.assumptions)
        document["assumptions"].push_back(assumption.text);
    document["states"] = report.states;
    document["complete"] = report.complete;
    document["unreachable"] = Json::array();
    for (const std::uint8_t step : report.unreachable) {
        if (input.symbols && !names.steps[step].empty()) {
            document["unreachable"].push_back(names.steps[step]);
        } else {
            document["unreachable"].push_back(step);
        }
    }
    document["results"] = Json::array();
    for (const verify::Result& result : report.results) {
        Json& added = document["results"].emplace_back();
        added["name"] = result.name;
        if (!result.code.empty()) added["code"] = result.code;
        added["verdict"] = word_of(result.verdict);
        added["severity"] = result.severity == verify::Severity::fault ? "fault" : "advice";
        added["property"] = result.text;
        if (!result.reason.empty()) added["reason"] = result.reason;
        if (!result.allowed.empty()) added["allowed"] = result.allowed;
        if (result.course) added["course"] = course_object(*result.course, names);
    }
    return document;
}

struct Position {
    std::size_t line = 1;
    std::size_t column = 1;
};

Position position_of_step(const Compilation& program, std::string_view source, std::uint8_t step) {
    Position at;
    for (const StepOrigin& origin : program.steps) {
        if (origin.number != step) continue;
        const std::string_view before = source.substr(0, origin.span.offset);
        at.line += static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
        at.column = before.size() - (before.rfind('\n') + 1) + 1;
    }
    return at;
}

std::string assumption_text(const std::string& assume, const std::vector<verify::Assumption>& more) {
    std::string text = assume == "any"
                           ? "inputs, INPOS, ERROR and the time between scans are free (--assume any)"
                           : "what the gateway and a real motor can do (--assume driver)";
    for (const verify::Assumption& assumption : more) text += "; " + assumption.text;
    return text;
}

/// What a check found, where the step stands.
std::string finding_text(const verify::Result& result, const VerifyArguments& options, const Input& input,
                         const verify::Names& names) {
    const bool is_fault = result.severity == verify::Severity::fault;
    const char* word = result.verdict == Verdict::undecided ? "undecided"
                       : !result.allowed.empty()            ? "allowed"
                       : is_fault                           ? "fault"
                                                            : "advice";
    std::string place = options.table.file;
    if (input.program && result.step) {
        const Position at = position_of_step(*input.program, input.source, *result.step);
        place += fmt::format(":{}:{}", at.line, at.column);
    }
    std::string text = fmt::format(
        "{}: {} {}\n", place,
        painted(stdout, is_fault ? "1;31" : "1;33", fmt::format("{} {}:", word, result.code)), result.reason);
    if (!result.allowed.empty()) text += fmt::format("  because {}\n", result.allowed);
    if (is_fault && result.course) text += story_of(*result.course, names);
    return text;
}

std::string text_of(const verify::Report& report, const VerifyArguments& options, const Input& input,
                    const verify::Names& names) {
    std::string text;
    std::size_t checks_that_hold = 0;
    for (const verify::Result& result : report.results) {
        if (!result.code.empty()) {
            const bool holds = result.verdict == Verdict::proved;
            checks_that_hold += holds ? 1 : 0;
            if (!holds) text += finding_text(result, options, input, names);
            continue;
        }
        const char* shade = result.verdict == Verdict::proved ? "1;32" : "1;31";
        text +=
            fmt::format("{} {}: {}\n", painted(stdout, shade, fmt::format("{:<9}", word_of(result.verdict))),
                        result.name, result.text);
        if (!result.reason.empty()) text += fmt::format("  {}\n", result.reason);
        if (result.verdict == Verdict::broken && result.course) text += story_of(*result.course, names);
    }
    return text + fmt::format("{} of {} checks hold; {} states explored{}; assumed: {}\n", checks_that_hold,
                              verify::checks().size(), report.states,
                              report.complete ? ", all there are" : ", not all",
                              assumption_text(options.assume, report.assumptions));
}

/// OUT.scn for the first, OUT-Name.scn for the others.
std::string file_for(const std::string& file, const std::string& name, bool is_first) {
    if (is_first) return file;
    const std::size_t slash = file.find_last_of("/\\");
    std::size_t dot = file.rfind('.');
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) dot = file.size();
    return file.substr(0, dot) + "-" + name + file.substr(dot);
}

int write_courses(const verify::Report& report, const VerifyArguments& options, const verify::Names& names) {
    std::vector<whole_files::OutputFile> files;
    bool is_first = true;
    for (const verify::Result& result : report.results) {
        if (result.verdict != Verdict::broken || !result.course || !result.code.empty()) continue;
        if (!options.stimulus.empty()) {
            files.push_back(
                {file_for(options.stimulus, result.name, is_first), verify::stimulus_of(*result.course)});
        }
        if (!options.scenario.empty()) {
            files.push_back(
                {file_for(options.scenario, result.name, is_first), verify::scenario_of(result, names)});
        }
        is_first = false;
    }
    if (!options.junit.empty()) files.push_back({options.junit, junit_of(report, options.table.file, names)});
    const std::string error = whole_files::write_files(files);
    return error.empty() ? kOk : file_problem(error);
}

/// What does not go together.
std::string contradiction(const VerifyArguments& options) {
    if (options.emit.empty()) return options.output.empty() ? "" : "-o goes with --emit";
    if (options.json || !options.junit.empty() || !options.scenario.empty() || !options.stimulus.empty() ||
        !options.proof.empty())
        return "--emit decides nothing: it does not go with --json, --junit, --scenario, --stimulus or "
               "--proof";
    if (options.assume != "any") {
        return "--emit writes what --assume any asks, so say --assume any: the debounce time, the times of "
               "orders and the lost link of --assume driver are not written for foreign checkers";
    }
    return "";
}

int run(const VerifyArguments& options) {
    if (const std::string wrong = contradiction(options); !wrong.empty()) return file_problem(wrong);
    const Input input = read_for_view(options.table);
    if (input.exit_code != kOk) return kUsageOrFile;
    const auto loaded = sequencer::Table::load(input.table);
    if (!loaded.ok) {
        return file_problem(
            fmt::format("{}: {}", options.table.file, sequencer::describe(loaded.fault.error)));
    }
    const verify::Names names = names_for(input);
    verify::PropertyReading reading = properties_in(input, names);
    if (!reading.error.empty())
        return file_problem(fmt::format("{}:{}: {}", options.table.file, reading.line, reading.error));
    std::vector<verify::Property> properties = std::move(reading.properties);
    std::vector<verify::Assumption> assumptions = std::move(reading.assumptions);
    if (!options.properties.empty()) {
        const whole_files::FileText text = whole_files::read_text(options.properties);
        if (!text.error.empty()) return file_problem(text.error);
        reading = verify::read_properties(text.text, names);
        if (!reading.error.empty())
            return file_problem(fmt::format("{}:{}: {}", options.properties, reading.line, reading.error));
        properties.insert(properties.end(), reading.properties.begin(), reading.properties.end());
        assumptions.insert(assumptions.end(), reading.assumptions.begin(), reading.assumptions.end());
    }
    if (verify::contradict(assumptions)) {
        return file_problem(options.table.file +
                            ": the assumptions allow no inputs at all, so anything would be proved: "
                            "leave out one ASSUME NEVER");
    }
    if (!options.emit.empty() && !assumptions.empty())
        return file_problem("--emit writes what --assume any asks: leave ASSUME out");
    if (!options.emit.empty()) return emit_question(options.emit, input, properties, options.output);
    const bool translated = input.symbols && input.symbols->drive != nullptr;
    verify::Options how;
    how.assume = options.assume == "any" ? Assume::any : Assume::driver;
    how.order_time = [translated](std::span<const sequencer::MotorOrder> orders) {
        return order_time(orders, translated);
    };
    how.assumptions = assumptions;
    if (input.program) {
        for (const Allowance& allowance : input.program->allowances)
            how.allowances.push_back({allowance.code, allowance.step, allowance.reason});
    }
    const verify::Report report = verify::verify(loaded.table, names, properties, how);
    if (const int written = write_courses(report, options, names); written != kOk) return written;
    const int verdict = exit_code_of(report);
    if (!options.proof.empty()) {
        const int written = write_certificate(options.proof, report, verdict == kOk, input, options.assume,
                                              assumption_text(options.assume, report.assumptions));
        if (written != kOk) return written;
    }
    if (options.json) return print_json(document_of(report, options, input, names), verdict);
    const int printed = print_or_write(text_of(report, options, input, names), {});
    return printed == kOk ? verdict : printed;
}

}  // namespace

void add_verify(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<VerifyArguments>();
    options->table.is_whole = true;
    arguments::App& command = *app.add_subcommand(
        "verify", "Explore all that a program or table can do, and prove properties or show how they break");
    command.add_option("file", options->table.file, "A program, F.seq, or a table")->required();
    add_symbols_option(command, options->table);
    command.add_option("--property", options->properties, "Properties to prove")->type_name("P.prop");
    command
        .add_option("--assume", options->assume,
                    "driver: what gateway and motor can do (default); any: all inputs and times are free")
        ->one_of({"driver", "any"});
    command.add_flag("--json", options->json, "JSON for other programs");
    command
        .add_option("--junit", options->junit,
                    "Write the verdicts as JUnit's XML, for continuous integration")
        ->type_name("F.xml");
    command
        .add_option(
            "--stimulus", options->stimulus,
            "Write the course that breaks a property, for nanoplc-sim scan; of further ones OUT-Name.csv")
        ->type_name("OUT.csv");
    command
        .add_option("--scenario", options->scenario,
                    "The same as inputs for nanoplc-sim run; of further ones OUT-Name.scn")
        ->type_name("OUT.scn");
    command
        .add_option("--emit", options->emit,
                    "Decide nothing: write the question of --assume any for Spin or Z3")
        ->one_of({"promela", "smt2"});
    command.add_option("-o,--output", options->output, "Where --emit writes, instead of standard output (-)")
        ->type_name("FILE");
    command
        .add_option("--proof", options->proof,
                    "Write a certificate of the table, for nanoctl upload --proof, if all is proved")
        ->type_name("F.proof");
    command.footer(
        "Exit codes: 0 all properties proved, 1 one is broken, 4 none is broken and one is undecided,\n"
        "2 wrong usage, a program with errors, or a file that cannot be read, written or understood.");
    command.callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nplc::seqc::cli
