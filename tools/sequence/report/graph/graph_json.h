#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/graph/graph_model.h"
#include "report/graph/graph_picture.h"

namespace nplc::seqc {

/// The drawing for other programs: its elements and positions.
nlohmann::ordered_json graph_json_of(const GraphModel& model, const Picture& picture);

}  // namespace nplc::seqc
