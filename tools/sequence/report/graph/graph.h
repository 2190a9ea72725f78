#pragma once

#include <span>
#include <string>

#include "report/graph/graph_model.h"

namespace nplc::seqc {

/// The table as a drawing for an A4 page, in Graphviz syntax. Deterministic. `title` is used if there are no
/// symbols.
std::string graph_of(std::span<const std::uint8_t> table, const Symbols* symbols, const std::string& title,
                     const GraphSource& source = {});

}  // namespace nplc::seqc
