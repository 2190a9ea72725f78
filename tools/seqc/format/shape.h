#pragma once

#include "format/item.h"

namespace nplc::seqc::layout {

inline constexpr std::size_t kIndent = 4;
inline constexpr std::size_t kWidestOneLiner = 100;
inline constexpr std::size_t kWidest = 120;  ///< beyond it a line is broken

/// Decides which tokens begin a line, on which level, and how many blanks stand before the others. A block
/// that its author wrote on one line stays on one if it holds a single thing and is not too wide.
void shape(Document& document);

}  // namespace nplc::seqc::layout
