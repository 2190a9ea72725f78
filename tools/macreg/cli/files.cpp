#include "cli/files.h"

#include <fmt/format.h>

#include "cli/session.h"
#include "command_line/files.h"

namespace nplc::macreg::cli {

ParameterSet read_parameter_file(const std::string& path, bool partial) {
    const ParsedFile file = parse_parameters(command_line::read_whole(path));
    if (!file.problems.empty()) {
        const FileProblem& first = file.problems.front();
        const std::string place = first.line == 0 ? "" : fmt::format("{}:", first.line);
        const std::string more =
            file.problems.size() == 1 ? "" : fmt::format(" (and {} more problems)", file.problems.size() - 1);
        throw UserError(fmt::format("{}:{} {}{}", path, place, first.text, more));
    }
    if (!file.set.incomplete.empty() && !partial)
        throw UserError(fmt::format("{}: is incomplete: {}; dump again, or take it as it is with --partial",
                                    path, file.set.incomplete));
    return file.set;
}

}  // namespace nplc::macreg::cli
