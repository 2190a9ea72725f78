#include "cli/verify_courses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/course_scenario.h"
#include "analysis/story.h"
#include "cli/common.h"
#include "cli/course_steps.h"
#include "cli/motor_lines.h"
#include "host/paths.h"
#include "host/process.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

constexpr const char* kPlayer = "nanoplc-sim";

/// Runs the player next to this program, else the one on the path.
host::Ran run_player(const std::vector<std::string>& arguments, const std::string& scenario) {
    const std::string folder = host::own_folder();
    if (!folder.empty()) {
        const std::string beside = host::name_of(host::path_of(folder) / kPlayer);
        host::Ran ran = host::run_program(beside, arguments, scenario);
        if (!ran.missing) return ran;
    }
    return host::run_program(kPlayer, arguments, scenario);
}

/// Played before it is written, in a separate program with the simulated gateway.
Play play_scenario(const InputFile& program, const std::string& file, const std::string& text,
                   const CourseSteps& steps, bool has_plant) {
    std::vector<std::string> arguments = {"run", program.file, "--scenario", "/dev/stdin"};
    if (!program.symbols.empty()) arguments.insert(arguments.end(), {"--symbols", program.symbols});
    const host::Ran ran = run_player(arguments, text);
    if (ran.missing)
        return {file, Played::not_at_all, "nanoplc-sim was not found beside seqc or on the path"};
    if (!ran.problem.empty()) return {file, Played::not_at_all, ran.problem};
    if (ran.status == 0) return {file, Played::to_the_end, {}};
    if (ran.status == 1) {
        Deviation leaves = where_it_leaves(steps, steps_in_timeline(ran.output));
        if (leaves.is_plant && !has_plant)
            leaves.where += "; for hard stops, a load or a plant of the machine's there is --plant FILE";
        return {file, Played::otherwise, std::move(leaves.where), leaves.by_motor};
    }
    return {file, Played::not_at_all,
            fmt::format("nanoplc-sim refused it: {}", ran.errors.substr(0, ran.errors.find('\n')))};
}

/// A scenario with the result of its rehearsal.
struct Rehearsed {
    Play play;
    std::string text;
};

/// What follows behind the file's name.
std::string cannot(const Play& play) {
    if (play.by_motor) return fmt::format("the virtual motor cannot follow {}: {}", play.file, play.why);
    return fmt::format(
        "nanoplc-sim run does not come to the end of {}: {}; it debounces inputs for 3 ms and takes its own "
        "times for scans and orders, and this course needs others to the millisecond",
        play.file, play.why);
}

/// Inputs that change before the scan that leaves a step or after it, or soon after the event before: until
/// one leads to the same end. What the motor does otherwise stays so.
Rehearsed rehearsed(const verify::Result& result, const InputFile& program, const std::string& file,
                    const verify::Names& names, const std::vector<std::string>& plant) {
    constexpr std::uint32_t kLongest = 3;  // milliseconds; from there on debouncing is over
    const CourseSteps steps = steps_of(*result.course, names);
    std::vector<verify::ScenarioOptions> ways{{.plant = plant}, {.plant = plant, .changes_late = true}};
    for (const std::uint32_t back : {1U, 2U}) {
        for (std::uint32_t ms = 1; ms <= kLongest; ++ms)
            ways.push_back({.plant = plant, .ahead_ms = ms, .steps_back = back});
    }
    std::optional<Rehearsed> first;
    for (const verify::ScenarioOptions& how : ways) {
        if (first && first->play.by_motor && how.ahead_ms != 0) break;
        std::string text = verify::scenario_of(result, names, how);
        if (first && text == first->text) continue;
        Play play = play_scenario(program, file, text, steps, !plant.empty());
        const bool is_done = play.played != Played::otherwise;
        if (is_done && (!first || play.played == Played::to_the_end))
            return {std::move(play), std::move(text)};
        if (!first) first = Rehearsed{std::move(play), std::move(text)};
    }
    const std::string what =
        first->play.by_motor
            ? fmt::format("The virtual motor cannot follow this course: {}", first->play.why)
            : fmt::format("nanoplc-sim run does not come to the end of this course: {}", first->play.why);
    first->text =
        fmt::format("# {}.\n# With --stimulus it is written for nanoplc-sim scan, which always follows.\n{}",
                    what, first->text);
    return std::move(*first);
}

/// Error if a file would overwrite an input or another output.
std::string clash_in(const std::vector<whole_files::OutputFile>& files,
                     const std::vector<std::string>& read) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string& file = files[i].path;
        for (const std::string& other : read) {
            if (is_same_file(file, other))
                return fmt::format("'{}' was read: name another file to write", file);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (is_same_file(file, files[j].path))
                return fmt::format("'{}' would be written twice: name another file", file);
        }
    }
    return {};
}

/// In the order of their files.
std::vector<const verify::Result*> broken_in(const verify::Report& report, const verify::Names& names) {
    std::vector<const verify::Result*> properties;
    std::vector<const verify::Result*> faults;
    for (const verify::Result& result : report.results) {
        if (result.verdict != verify::Verdict::broken || !result.course) continue;
        std::string copies;
        if (result.code.empty()) {
            properties.push_back(&result);
        } else if (result.severity == verify::Severity::fault && !result.course->empty() &&
                   told_for(report, result, names, copies) != nullptr) {
            faults.push_back(&result);
        }
    }
    properties.insert(properties.end(), faults.begin(), faults.end());
    return properties;
}

/// An old file could be taken for one of this run.
std::string untouched_text(const CourseFiles& wanted) {
    std::string text;
    for (const std::string& file : {wanted.scenario, wanted.stimulus, wanted.trace}) {
        if (file.empty()) continue;
        std::error_code ignored;
        const bool is_there = file != "-" && std::filesystem::exists(host::path_of(file), ignored);
        text += fmt::format("nothing to write: no course breaks a property or shows a fault; {} {}\n", file,
                            is_there ? "is as it was before, and not of this run" : "was not written");
    }
    return text;
}

}  // namespace

const verify::Result* told_for(const verify::Report& report, const verify::Result& result,
                               const verify::Names& names, std::string& copies) {
    if (!result.step) return &result;
    const auto origin_of = [&](std::uint8_t step) { return names.copy_of[step].value_or(step); };
    std::vector<const verify::Result*> same;
    for (const verify::Result& other : report.results) {
        if (other.step && other.code == result.code && other.verdict == result.verdict &&
            other.allowed == result.allowed && origin_of(*other.step) == origin_of(*result.step))
            same.push_back(&other);
    }
    const auto origin = std::find_if(same.rbegin(), same.rend(), [&](const verify::Result* other) {
        return *other->step == origin_of(*other->step);
    });
    const verify::Result* const first = origin == same.rend() ? same.front() : *origin;
    if (first != &result) return nullptr;
    for (const verify::Result* other : same) {
        if (other != first)
            copies += fmt::format("{}{}", copies.empty() ? "" : ", ", names.steps[*other->step]);
    }
    return first;
}

std::string file_for(const std::string& file, const std::string& name, bool is_first) {
    if (is_first) return file;
    const std::size_t slash = file.find_last_of("/\\");
    std::size_t dot = file.rfind('.');
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) dot = file.size();
    return file.substr(0, dot) + "-" + name + file.substr(dot);
}

std::string written_courses(const verify::Report& report, const CourseFiles& wanted, const InputFile& program,
                            const verify::Names& names, Plays& plays, std::string& untouched) {
    const MotorLines plant = wanted.plant.empty() ? MotorLines{} : motor_lines_of(wanted.plant);
    if (!plant.error.empty()) return plant.error;
    std::vector<whole_files::OutputFile> files;
    bool is_first = true;
    for (const verify::Result* broken : broken_in(report, names)) {
        const verify::Result& result = *broken;
        const auto add = [&](const std::string& file, std::string text) {
            files.push_back({file_for(file, result.name, is_first), std::move(text)});
        };
        if (!wanted.stimulus.empty()) add(wanted.stimulus, verify::stimulus_of(result));
        if (!wanted.trace.empty()) add(wanted.trace, verify::trace_of(*result.course));
        if (!wanted.scenario.empty()) {
            Rehearsed done = rehearsed(result, program, file_for(wanted.scenario, result.name, is_first),
                                       names, plant.lines);
            add(wanted.scenario, std::move(done.text));
            plays.insert_or_assign(result.name, std::move(done.play));
        }
        is_first = false;
    }
    if (is_first) untouched = untouched_text(wanted);
    std::string error = clash_in(files, wanted.read);
    return error.empty() ? whole_files::write_files(files) : error;
}

std::string told(const Play& play) {
    switch (play.played) {
        case Played::to_the_end:
            return fmt::format("nanoplc-sim run plays {} to the same end", play.file);
        case Played::otherwise:
            return cannot(play) + "; play it with --stimulus and nanoplc-sim scan";
        case Played::not_at_all:
            break;
    }
    return fmt::format("{} was not played: {}", play.file, play.why);
}

}  // namespace nplc::seqc::cli
