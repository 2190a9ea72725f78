#pragma once

#include <span>
#include <string>
#include <vector>

namespace nplc::macreg {

/// A curve in `width` by `height` characters of UTF-8, highest row first: braille patterns of 2 by 4 dots
/// each, or `*` for terminals without them. The values spread over the whole width and from `low` to `high`.
std::vector<std::string> text_curve(std::span<const double> values, int width, int height, double low,
                                    double high, bool braille);

}  // namespace nplc::macreg
