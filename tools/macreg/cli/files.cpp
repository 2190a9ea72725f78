#include "cli/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "command_line/files.h"
#include "host/interruption.h"
#include "whole_files/whole_files.h"

namespace nplc::macreg::cli {

namespace {

/// All that is wrong, so that it can be mended at once.
command_line::Failure bad_file(const std::string& name, const std::vector<FileProblem>& problems) {
    constexpr std::size_t kMost = 20;
    const auto line_of = [&](const FileProblem& one) {
        return fmt::format("{}:{} {}", name, one.line == 0 ? "" : fmt::format("{}:", one.line), one.text);
    };
    Json list = Json::array();
    for (const FileProblem& one : problems) list.push_back({{"line", one.line}, {"problem", one.text}});
    std::string text = line_of(problems.front());
    if (problems.size() > 1) {
        text = fmt::format("{}: {}, nothing was written", name, counted(problems.size(), "problem"));
        for (std::size_t i = 0; i < problems.size() && i < kMost; ++i) text += "\n  " + line_of(problems[i]);
        if (problems.size() > kMost) text += fmt::format("\n  and {} more", problems.size() - kMost);
    }
    return {command_line::kUsageOrFile, text, {{"problems", list}}};
}

}  // namespace

std::string read_standard_input() {
    host::end_at_interruptions();
    whole_files::FileText input = whole_files::read_standard_input();
    host::note_interruptions();
    if (!input.error.empty()) throw UserError(input.error);
    return std::move(input.text);
}

std::string model_words(const ParameterSet& set) {
    const bool known = set.model_is_known || set.model == registers::Model::mac800;
    return known ? fmt::format("a {}", registers::name_of(set.model)) : "one of MAC50 to MAC141";
}

ParameterSet read_parameter_file(const std::string& path, bool partial) {
    const bool standard = path == "-";
    const std::string name = standard ? "standard input" : path;
    const ParsedFile file =
        parse_parameters(standard ? read_standard_input() : command_line::read_whole(path));
    if (!file.problems.empty()) throw bad_file(name, file.problems);
    if (!file.set.incomplete.empty() && !partial)
        throw UserError(fmt::format("{}: is incomplete: {}; dump again, or take it as it is with --partial",
                                    name, file.set.incomplete));
    return file.set;
}

}  // namespace nplc::macreg::cli
