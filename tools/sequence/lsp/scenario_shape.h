#pragma once

#include <vector>

#include "lsp/features.h"

/// Line-based features of scenarios and property files: outline, folding, selections, and fixes for misspelt
/// words.
namespace nplc::seqc::lsp {

/// One symbol per statement.
Json scenario_symbols(const Workspace& workspace, const At& at);
/// Comments of several lines.
Json text_folds(const analysis::Lines& lines);
/// Selection ranges: the word, the line without its comment, the text.
std::vector<Span> scenario_selections(const At& at, std::uint32_t offset);
/// Fixes for misspelt words in the lines of a range.
Json scenario_fixes(const Workspace& workspace, const At& at, const Json& params);

}  // namespace nplc::seqc::lsp
