#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

struct Layout {
    std::vector<TextEdit> edits;
    std::string error;  ///< why it cannot be formatted
};

/// The changes of `seqc fmt` for the whole program.
Layout format_whole(const Program& program);
/// The same for the lines in `range` only.
Layout format_range(const Program& program, Span range);
/// While typing: indentation of the line at `offset`. `begins_line`: the line was just begun; else it is
/// changed only if it is a word that ends or divides a block.
Layout format_typed(const Program& program, std::uint32_t offset, bool begins_line);

}  // namespace nplc::seqc::analysis
