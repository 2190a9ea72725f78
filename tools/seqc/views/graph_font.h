#pragma once

#include <string_view>

namespace nplc::seqc {

/// Room for `text` in points, whatever usual font draws it: the widest of a sans serif and a monospaced one.
double text_width(std::string_view text, double size, bool bold = false);

}  // namespace nplc::seqc
