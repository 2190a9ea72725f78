#pragma once

#include <cstdint>
#include <vector>

#include "views/graph_columns.h"

namespace nplc::seqc {

/// Which lines are drawn; for the rest the arrow in the box says where it goes on.
enum class LinesDrawn : std::uint8_t { all, beside, neighbours };  ///< beside: none past a column

struct Routes {
    std::vector<Picture::Line> lines;
    double width = 0;
    double height = 0;
};

/// Draws lines around the cards, never over one, and gives the cards their places across. All that leads to
/// one step runs together before it.
Routes route(CardColumns& columns, const GraphModel& model, LinesDrawn drawn);

}  // namespace nplc::seqc
