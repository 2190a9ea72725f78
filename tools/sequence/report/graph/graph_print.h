#pragma once

#include <string>

#include "report/graph/graph_picture.h"

namespace nplc::seqc {

/// The picture for `neato -n2`, which renders it as PNG or PDF: all positions are fixed.
std::string print_of(const Picture& picture);

}  // namespace nplc::seqc
