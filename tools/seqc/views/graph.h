#pragma once

#include <span>
#include <string>

#include "views/graph_model.h"

namespace nplc::seqc {

/// The table as a drawing for an A4 page, in Graphviz' language. The same table gives the same text.
/// `title` where there are no symbols.
std::string graph_of(std::span<const std::uint8_t> table, const Symbols* symbols, const std::string& title,
                     const GraphSource& source = {});

}  // namespace nplc::seqc
