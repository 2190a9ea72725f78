#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/program.h"

namespace nplc::seqc::analysis {

struct Layout {
    std::vector<TextEdit> edits;
    std::string error;  ///< why there is no layout
};

/// As `seqc fmt` lays it out; only what changes.
Layout format_whole(const Program& program);
/// Only the lines that `range` touches.
Layout format_range(const Program& program, Span range);
/// While typing: the depth of the line in which `offset` stands. `begins_line`: it was just begun; else it is
/// changed only if a word of its own ends or parts a block.
Layout format_typed(const Program& program, std::uint32_t offset, bool begins_line);

}  // namespace nplc::seqc::analysis
