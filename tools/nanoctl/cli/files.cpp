#include "cli/files.h"

#include <fmt/format.h>

#include "cli/session.h"
#include "command_line/files.h"
#include "intel_hex/intel_hex.h"
#include "sequencer/table.h"
#include "whole_files/whole_files.h"

namespace nplc::nanoctl::cli {

using command_line::read_whole;

std::vector<std::uint8_t> read_table(const std::string& path) {
    const std::string content = read_whole(path);
    std::vector<std::uint8_t> table(content.begin(), content.end());
    if (intel_hex::is_file(path, content)) {
        const intel_hex::Image image = intel_hex::read(content);
        if (!image.error.empty()) throw UserError(fmt::format("{}:{}: {}", path, image.line, image.error));
        table = image.bytes;
    }
    const auto loaded = sequencer::Table::load(table);
    if (!loaded.ok)
        throw UserError(fmt::format("{}: term {}: {}; this is no table of seqc build", path,
                                    loaded.fault.term, sequencer::describe(loaded.fault.error)));
    const std::size_t whole = (loaded.table.size() + 1) * sequencer::kTermBytes;
    if (table.size() != whole)
        throw UserError(
            fmt::format("{}: term {} ends the table and {} bytes follow it; this is no table of "
                        "seqc build, build it anew",
                        path, loaded.table.size(), table.size() - whole));
    return table;
}

void write_table(const std::string& path, std::span<const std::uint8_t> table) {
    const std::string content =
        intel_hex::has_extension(path) ? intel_hex::write(table) : std::string(table.begin(), table.end());
    if (const std::string problem = whole_files::write_files({{path, content}}); !problem.empty())
        throw UserError(problem);
}

}  // namespace nplc::nanoctl::cli
