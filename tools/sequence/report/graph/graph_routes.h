#pragma once

#include <cstdint>
#include <vector>

#include "report/graph/graph_columns.h"

namespace nplc::seqc {

/// The lines to draw; for others the arrow in the box shows the target.
enum class LinesDrawn : std::uint8_t { all, beside, neighbours };  ///< beside: none past a column

struct Routes {
    std::vector<Picture::Line> lines;
    double width = 0;
    double height = 0;
};

/// Routes lines around the cards, never over one, and sets the cards' horizontal positions. All lines to one
/// step are merged before it.
Routes route(CardColumns& columns, const GraphModel& model, LinesDrawn drawn);

}  // namespace nplc::seqc
