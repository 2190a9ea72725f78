#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "views/graph_model.h"

namespace nplc::seqc {

inline constexpr std::size_t kBoxWidth = 36;  ///< characters of a line in a step

using LinePair = std::pair<std::uint8_t, std::uint8_t>;  ///< from, to

/// The pairs of steps between which a line may be drawn, and whether only ERROR leads along it.
std::map<LinePair, bool> lines_of(const GraphModel& model);

/// Names of nodes, "s5" for a step and "n0" for a note, in columns for one page: what is readable where a
/// layout by the lines would be a thread. One column: let the lines decide.
std::vector<std::vector<std::string>> columns_of(const GraphModel& model);

}  // namespace nplc::seqc
