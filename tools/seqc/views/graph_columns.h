#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "views/graph_cards.h"
#include "views/graph_model.h"

namespace nplc::seqc {

using CardColumns = std::vector<std::vector<Card>>;

/// Places in `model.boxes` in the order in which a person reads them: along the ways, what notes lead to
/// last.
std::vector<std::size_t> reading_order(const GraphModel& model);

/// The model's cards one below the other in so many columns or fewer, about equally high; a note above its
/// step. Heights are set, and all widths but those of notes are their column's.
CardColumns columns_of(const GraphModel& model, std::size_t columns, std::size_t letters);

}  // namespace nplc::seqc
