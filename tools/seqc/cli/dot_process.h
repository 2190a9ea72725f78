#pragma once

#include <string>

namespace nplc::seqc::cli {

struct Rendering {
    std::string bytes;
    std::string error;  ///< why there are none, in one line
};

/// What Graphviz' `dot -Tformat` makes of `text`. No shell is involved; nothing is left behind.
Rendering render_dot(const std::string& text, const std::string& format);

}  // namespace nplc::seqc::cli
