#pragma once

#include <string>

#include "views/graph_picture.h"

namespace nplc::seqc {

/// The picture for `neato -n2`, which makes a PNG or a PDF of it: everything has its place already.
std::string print_of(const Picture& picture);

}  // namespace nplc::seqc
