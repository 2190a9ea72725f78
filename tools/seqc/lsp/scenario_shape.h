#pragma once

#include <vector>

#include "lsp/features.h"

/// The lines of scenarios and property files: outline, folds, selections, and words that a mistake means.
namespace nplc::seqc::lsp {

/// A symbol a sentence.
Json scenario_symbols(const Workspace& workspace, const At& at);
/// Comments of several lines.
Json text_folds(const analysis::Lines& lines);
/// The word, the line without its comment, the text.
std::vector<Span> scenario_selections(const At& at, std::uint32_t offset);
/// Words to write in the place of those that are misspelt, for the lines that a range touches.
Json scenario_fixes(const Workspace& workspace, const At& at, const Json& params);

}  // namespace nplc::seqc::lsp
