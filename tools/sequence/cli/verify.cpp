#include "analysis/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "analysis/story.h"
#include "cli/common.h"
#include "cli/input.h"
#include "cli/json.h"
#include "cli/junit.h"
#include "cli/subcommands.h"
#include "cli/verify_courses.h"
#include "cli/verify_emit.h"
#include "cli/verify_proof.h"
#include "cli/verify_set_points.h"
#include "report/verify_question.h"
#include "seqc/properties.h"
#include "sequencer/table.h"
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
    CourseFiles courses;
    std::string set_points = "free";
    std::string junit;
    std::string emit;
    std::string output;
    std::string proof;
    bool json = false;
    bool explains_undecided = false;
};

verify::Names names_for(const Input& input) {
    return input.symbols ? verify_names(*input.symbols) : verify_names();
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
    bool undecided = false;
    for (const verify::Result& result : report.results) {
        if (result.verdict == Verdict::broken && result.severity == verify::Severity::fault) return kBroken;
        undecided = undecided || result.verdict == Verdict::undecided;
    }
    return undecided ? kUndecided : kOk;
}

/// A wait of an hour has millions of scans: equal consecutive scans are counted instead.
Json course_object(const verify::Course& course, const verify::Names& names) {
    Json scans = Json::array();
    for (const verify::PlayedScan& scan : course) {
        if (scan.repeats && !scans.empty() && scans.back()["dt_ms"] == scan.dt_ms) {
            scans.back()["times"] = scans.back().value("times", 1U) + 1;
            continue;
        }
        Json& added = scans.emplace_back();
        added["inputs"] = scan.image & sequencer::kInputsMask;
        added["inpos"] = (scan.image & sequencer::kInPos) != 0 ? 1 : 0;
        added["error"] = (scan.image & sequencer::kError) != 0 ? 1 : 0;
        added["dt_ms"] = scan.dt_ms;
        if (scan.begins) added["time_begins"] = true;
        added["step"] = verify::step_name(names, scan.after.step);
        added["outputs"] = scan.after.outputs;
        added["timer"] = scan.after.timer;
        added["counter"] = scan.after.counter;
        Json& orders = added["orders"] = Json::array();
        for (const sequencer::MotorOrder& order : scan.orders)
            orders.push_back(verify::order_text(order, names));
    }
    return scans;
}

Json play_object(const Play& play) {
    Json object;
    object["file"] = play.file;
    object["plays"] = play.played == Played::not_at_all ? Json() : Json(play.played == Played::to_the_end);
    if (!play.why.empty()) object["why"] = play.why;
    return object;
}

bool has_set_points(const Input& input) {
    return input.symbols && !input.symbols->set_points.values.empty();
}

Json document_of(const verify::Report& report, const Plays& plays, const VerifyArguments& options,
                 const Input& input, const verify::Names& names) {
    Json document;
    document["file"] = options.table.file;
    document["assume"] = options.assume;
    document["assumptions"] = Json::array();
    for (const verify::Assumption& assumption : report.assumptions)
        document["assumptions"].push_back(assumption.text);
    if (has_set_points(input)) document["set_points"] = options.set_points;
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
        if (result.vacuous) added["vacuous"] = true;
        if (result.only_by_error) added["only_by_error"] = true;
        added["severity"] = result.severity == verify::Severity::fault ? "fault" : "advice";
        added["property"] = result.text;
        if (!result.reason.empty()) added["reason"] = result.reason;
        if (!result.conflict.empty()) added["conflict"] = result.conflict;
        if (!result.allowed.empty()) added["allowed"] = result.allowed;
        if (result.course) added["course"] = course_object(*result.course, names);
        if (const auto play = plays.find(result.name); play != plays.end())
            added["scenario"] = play_object(play->second);
    }
    return document;
}

struct Position {
    std::size_t line = 1;
    std::size_t column = 1;
};

/// `file:line:column`, in bytes.
std::string place_of_step(const Input& input, std::uint8_t step) {
    std::uint32_t offset = input.sources->program().offset;
    for (const StepOrigin& origin : input.program->steps) {
        if (origin.number == step) offset = origin.span.offset;
    }
    const SourceFile& file = input.sources->file_at(offset);
    const std::string_view before = input.sources->text_of(file).substr(0, offset - file.offset);
    return fmt::format("{}:{}:{}", file.name, 1 + std::count(before.begin(), before.end(), '\n'),
                       before.size() - (before.rfind('\n') + 1) + 1);
}

std::string assumption_text(const VerifyArguments& options, const Input& input,
                            const std::vector<verify::Assumption>& more) {
    std::string text = options.assume == "any"
                           ? "inputs, INPOS, ERROR and the time between scans are free (--assume any)"
                           : "what the gateway and a real motor can do (--assume driver)";
    if (has_set_points(input)) {
        text += options.set_points == "free" ? "; set-points have any value of their ranges"
                                             : "; set-points have their defaults (--set-points default)";
    }
    for (const verify::Assumption& assumption : more) text += "; " + assumption.text;
    return text;
}

/// For an undecided result, on request: why the last candidate course is impossible.
std::string conflict_text(const verify::Result& result, const VerifyArguments& options) {
    if (!options.explains_undecided || result.conflict.empty()) return "";
    return fmt::format("  the last course: {}\n", result.conflict);
}

/// A fault; and of advice that the timer was not set, which the steps before it show.
bool tells_course(const verify::Result& result) {
    const bool is_fault = result.severity == verify::Severity::fault;
    return is_fault || (result.code == "V007" && result.allowed.empty());
}

/// The finding of a check, at the position of the step.
std::string finding_text(const verify::Result& result, const Plays& plays, const VerifyArguments& options,
                         const Input& input, const verify::Names& names) {
    const bool is_fault = result.severity == verify::Severity::fault;
    const char* word = result.verdict == Verdict::undecided ? "undecided"
                       : !result.allowed.empty()            ? "allowed"
                       : is_fault                           ? "fault"
                                                            : "advice";
    std::string place = options.table.file;
    if (input.program && result.step) {
        place = place_of_step(input, *result.step);
    }
    std::string text = fmt::format(
        "{}: {} {}\n", place,
        painted(stdout, is_fault ? "1;31" : "1;33", fmt::format("{} {}:", word, result.code)), result.reason);
    if (!result.allowed.empty()) text += fmt::format("  because {}\n", result.allowed);
    text += conflict_text(result, options);
    if (tells_course(result) && result.course) text += story_of(result, names);
    if (const auto play = plays.find(result.name); play != plays.end())
        text += fmt::format("  {}\n", told(play->second));
    return text;
}

std::string undecided_text(const verify::Report& report) {
    std::set<std::string> open;
    for (const verify::Result& result : report.results) {
        if (!result.code.empty() && result.verdict == Verdict::undecided) open.insert(result.code);
    }
    return open.empty() ? "" : fmt::format(", {} undecided", open.size());
}

std::string text_of(const verify::Report& report, const Plays& plays, const VerifyArguments& options,
                    const Input& input, const verify::Names& names) {
    std::string text;
    std::size_t checks_that_hold = 0;
    for (const verify::Result& result : report.results) {
        if (!result.code.empty()) {
            const bool holds = result.verdict == Verdict::proved;
            checks_that_hold += holds ? 1 : 0;
            std::string copies;
            if (holds || told_for(report, result, names, copies) == nullptr) continue;
            text += finding_text(result, plays, options, input, names);
            if (!copies.empty()) text += fmt::format("  and in its copies: {}\n", copies);
            continue;
        }
        const char* shade = result.verdict == Verdict::proved ? "1;32" : "1;31";
        text +=
            fmt::format("{} {}: {}\n", painted(stdout, shade, fmt::format("{:<9}", word_of(result.verdict))),
                        result.name, result.text);
        if (!result.reason.empty()) text += fmt::format("  {}\n", result.reason);
        text += conflict_text(result, options);
        if (result.verdict == Verdict::broken && result.course) text += story_of(result, names);
        if (const auto play = plays.find(result.name); play != plays.end())
            text += fmt::format("  {}\n", told(play->second));
    }
    return text + fmt::format("{} of {} checks hold{}; {} states explored{}; assumed: {}\n", checks_that_hold,
                              verify::checks().size(), undecided_text(report), report.states,
                              report.complete ? ", all there are" : ", not all",
                              assumption_text(options, input, report.assumptions));
}

/// Error if an output would overwrite an input.
std::string clash(const VerifyArguments& options) {
    const std::vector<std::string> read = {options.table.file, options.properties, options.table.symbols,
                                           options.courses.plant};
    std::vector<std::string> written;
    for (const std::string& file : {options.courses.scenario, options.courses.stimulus, options.courses.trace,
                                    options.junit, options.proof, options.output}) {
        if (file.empty() || file == "-") continue;
        for (const std::string& other : read) {
            if (!other.empty() && is_same_file(file, other))
                return fmt::format("'{}' is what is read: name another file to write", file);
        }
        for (const std::string& other : written) {
            if (is_same_file(file, other))
                return fmt::format("'{}' would be written twice: name another file", file);
        }
        written.push_back(file);
    }
    return "";
}

/// Error for contradicting options.
std::string contradiction(const VerifyArguments& options) {
    if (std::string wrong = clash(options); !wrong.empty()) return wrong;
    if (!options.courses.plant.empty() && options.courses.scenario.empty())
        return "--plant goes with --scenario";
    if (options.emit.empty()) return options.output.empty() ? "" : "-o goes with --emit";
    if (options.json || !options.junit.empty() || !options.courses.scenario.empty() ||
        !options.courses.stimulus.empty() || !options.courses.trace.empty() || !options.proof.empty())
        return "--emit decides nothing: it does not go with --json, --junit, --scenario, --stimulus, --trace "
               "or "
               "--proof";
    if (options.assume != "any") {
        return "--emit writes what --assume any asks, so say --assume any: the clocks of --assume driver "
               "(debouncing of six inputs, times of orders, lost links), in milliseconds, are more than a "
               "foreign checker can explore";
    }
    return "";
}

verify::Report explored(const VerifyArguments& options, const Input& input, const sequencer::Table& table,
                        const verify::Names& names, const std::vector<verify::Property>& properties,
                        const verify::Options& how) {
    const bool free = input.symbols && options.set_points == "free";
    return free ? verify_all_values(input.table, input.symbols->set_points, names, properties, how)
                : verify::verify(table, names, properties, how);
}

int emit(const VerifyArguments& options, const Input& input, const std::vector<verify::Property>& properties,
         const std::vector<verify::Assumption>& assumptions) {
    if (has_set_points(input) && options.set_points == "free")
        return file_problem("--emit asks about the set-points' defaults alone, so say --set-points default");
    return emit_question(options.emit, input, properties, assumptions, options.output);
}

/// With the inputs, which they must not overwrite.
CourseFiles course_files(const VerifyArguments& options) {
    CourseFiles files = options.courses;
    files.read = {options.table.file, options.properties, options.table.symbols,
                  options.junit,      options.proof,      options.courses.plant};
    std::erase(files.read, "");
    return files;
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
    PropertyReading reading;
    if (input.program) reading = properties_of(*input.sources, *input.symbols);
    std::vector<verify::Property> properties = std::move(reading.properties);
    std::vector<verify::Assumption> assumptions = std::move(reading.assumptions);
    if (!options.properties.empty()) {
        const whole_files::FileText text = whole_files::read_text(options.properties);
        if (!text.error.empty()) return file_problem(text.error);
        reading = read_properties(text.text, input.symbols.value_or(Symbols{}));
        if (!reading.diagnostics.empty()) {
            for (const Diagnostic& mistake : reading.diagnostics)
                std::fputs(render(mistake, text.text, options.properties, colour_of(stderr)).c_str(), stderr);
            return kUsageOrFile;
        }
        properties.insert(properties.end(), reading.properties.begin(), reading.properties.end());
        assumptions.insert(assumptions.end(), reading.assumptions.begin(), reading.assumptions.end());
    }
    if (verify::contradict(assumptions)) {
        return file_problem(options.table.file +
                            ": the assumptions allow no inputs at all, so anything would be proved: "
                            "leave out one ASSUME NEVER");
    }
    if (!options.emit.empty()) return emit(options, input, properties, assumptions);
    verify::Options how;
    how.assume = options.assume == "any" ? Assume::any : Assume::driver;
    how.order_time = order_times(input.symbols && input.symbols->drive != nullptr);
    how.assumptions = assumptions;
    if (input.program) how.allowances = allowances_in(*input.program);
    const verify::Report report = explored(options, input, loaded.table, names, properties, how);
    Plays plays;
    std::string untouched;
    std::string wrong =
        written_courses(report, course_files(options), options.table, names, plays, untouched);
    if (wrong.empty() && !options.junit.empty())
        wrong = whole_files::write_files({{options.junit, junit_of(report, options.table.file, names)}});
    if (!wrong.empty()) return file_problem(wrong);
    std::fputs(untouched.c_str(), stderr);
    const int verdict = exit_code_of(report);
    if (!options.proof.empty()) {
        const int written = write_certificate(options.proof, report, verdict == kOk, input, options.assume,
                                              assumption_text(options, input, report.assumptions));
        if (written != kOk) return written;
    }
    if (options.json) return print_json(document_of(report, plays, options, input, names), verdict);
    const int printed = print_or_write(text_of(report, plays, options, input, names), {});
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
    command
        .add_option("--set-points", options->set_points,
                    "free: what is proved holds for every value of the ranges (default); default: for the "
                    "table's own values alone")
        ->one_of({"free", "default"});
    command.add_flag("--json", options->json, "JSON for other programs");
    command.add_flag("--explain-undecided", options->explains_undecided,
                     "Of what is undecided for want of times: why the last course that was tried cannot be");
    command
        .add_option("--junit", options->junit,
                    "Write the verdicts as JUnit's XML, for continuous integration")
        ->type_name("F.xml");
    command
        .add_option(
            "--stimulus", options->courses.stimulus,
            "Write the course of a broken property or a fault, for nanoplc-sim scan; of others OUT-Name.csv")
        ->type_name("OUT.csv");
    command
        .add_option("--scenario", options->courses.scenario,
                    "The same as inputs for nanoplc-sim run, played with it to see whether the virtual motor "
                    "follows; of "
                    "further ones OUT-Name.scn")
        ->type_name("OUT.scn");
    command
        .add_option(
            "--plant", options->courses.plant,
            "What the motor of --scenario is like: what this scenario says of it at the beginning (stops, "
            "stored registers, load), or axis.toml")
        ->type_name("FILE");
    command
        .add_option("--trace", options->courses.trace,
                    "The same as a trace, for tools/plot_trace; of further ones OUT-Name.csv")
        ->type_name("OUT.csv");
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
