#include "cli/verify_courses.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "cli/common.h"
#include "host/paths.h"
#include "host/process.h"
#include "verify/story.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

constexpr const char* kPlayer = "nanoplc-sim";

/// The one beside this program, else the one on the path.
host::Ran run_player(const std::vector<std::string>& arguments) {
    const std::string folder = host::own_folder();
    if (!folder.empty()) {
        const std::string beside = host::name_of(host::path_of(folder) / kPlayer);
        host::Ran ran = host::run_program(beside, arguments, "");
        if (!ran.missing) return ran;
    }
    return host::run_program(kPlayer, arguments, "");
}

/// With the program of its own that holds the simulated gateway.
Play play_scenario(const InputFile& program, const std::string& file) {
    std::vector<std::string> arguments = {"run", program.file, "--scenario", file, "--quiet"};
    if (!program.symbols.empty()) arguments.insert(arguments.end(), {"--symbols", program.symbols});
    const host::Ran ran = run_player(arguments);
    if (ran.missing)
        return {file, Played::not_at_all, "nanoplc-sim was not found beside seqc or on the path"};
    if (!ran.problem.empty()) return {file, Played::not_at_all, ran.problem};
    if (ran.status == 0) return {file, Played::to_the_end, {}};
    if (ran.status == 1) return {file, Played::otherwise, {}};
    return {file, Played::not_at_all,
            fmt::format("nanoplc-sim refused it: {}", ran.errors.substr(0, ran.errors.find('\n')))};
}

constexpr const char* kNotFollowed =
    "# The virtual motor cannot follow this course: nanoplc-sim run does not come to its end. With\n"
    "# --stimulus it is written for nanoplc-sim scan.\n";

/// What would be written over something that was read, or over another of them.
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

}  // namespace

std::string file_for(const std::string& file, const std::string& name, bool is_first) {
    if (is_first) return file;
    const std::size_t slash = file.find_last_of("/\\");
    std::size_t dot = file.rfind('.');
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) dot = file.size();
    return file.substr(0, dot) + "-" + name + file.substr(dot);
}

std::string written_courses(const verify::Report& report, const CourseFiles& wanted, const InputFile& program,
                            const verify::Names& names, Plays& plays) {
    std::vector<whole_files::OutputFile> files;
    std::vector<const verify::Result*> broken;
    for (const verify::Result& result : report.results) {
        if (result.verdict != verify::Verdict::broken || !result.course || !result.code.empty()) continue;
        const bool is_first = broken.empty();
        broken.push_back(&result);
        if (!wanted.stimulus.empty()) {
            files.push_back(
                {file_for(wanted.stimulus, result.name, is_first), verify::stimulus_of(*result.course)});
        }
        if (!wanted.trace.empty())
            files.push_back(
                {file_for(wanted.trace, result.name, is_first), verify::trace_of(*result.course)});
        if (!wanted.scenario.empty()) {
            files.push_back(
                {file_for(wanted.scenario, result.name, is_first), verify::scenario_of(result, names)});
        }
    }
    std::string error = clash_in(files, wanted.read);
    if (error.empty()) error = whole_files::write_files(files);
    if (!error.empty() || wanted.scenario.empty()) return error;
    std::vector<whole_files::OutputFile> noted;
    for (const verify::Result* result : broken) {
        const std::string file = file_for(wanted.scenario, result->name, result == broken.front());
        const Play& play = plays.insert_or_assign(result->name, play_scenario(program, file)).first->second;
        if (play.played == Played::otherwise)
            noted.push_back({file, kNotFollowed + verify::scenario_of(*result, names)});
    }
    return whole_files::write_files(noted);
}

std::string told(const Play& play) {
    switch (play.played) {
        case Played::to_the_end:
            return fmt::format("nanoplc-sim run plays {} to the same end", play.file);
        case Played::otherwise:
            return fmt::format(
                "the virtual motor cannot follow {}: play it with --stimulus and nanoplc-sim scan",
                play.file);
        case Played::not_at_all:
            break;
    }
    return fmt::format("{} was not played: {}", play.file, play.why);
}

}  // namespace nplc::seqc::cli
