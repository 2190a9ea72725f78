#pragma once

#include <string>

#include "report/graph/graph_picture.h"

namespace nplc::seqc {

/// Deterministic. Each box is a group with its id, class "node" and its kind.
std::string svg_of(const Picture& picture, const std::string& title);

}  // namespace nplc::seqc
