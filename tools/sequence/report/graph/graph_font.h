#pragma once

#include <string_view>

namespace nplc::seqc {

/// Maximum width of `text` in points for common fonts: the larger of a sans serif and a monospaced one.
double text_width(std::string_view text, double size, bool bold = false);

}  // namespace nplc::seqc
