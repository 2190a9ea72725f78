#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "report/graph/graph_cards.h"
#include "report/graph/graph_model.h"

namespace nplc::seqc {

using CardColumns = std::vector<std::vector<Card>>;

/// Indices of `model.boxes` in reading order: along the transitions, targets of notes last.
std::vector<std::size_t> reading_order(const GraphModel& model);

/// The model's cards in up to `columns` columns of about equal height; a note above its step. Sets heights,
/// and all widths except those of notes to the column's.
CardColumns columns_of(const GraphModel& model, std::size_t columns, std::size_t letters);

}  // namespace nplc::seqc
