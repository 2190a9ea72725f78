#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::macreg {

/// A curve in `width` by `height` characters of UTF-8, highest row first: braille patterns of 2 by 4 dots
/// each, or `*` for terminals without them. The values spread over the whole width and from `low` to `high`.
std::vector<std::string> text_curve(std::span<const double> values, int width, int height, double low,
                                    double high, bool braille);

/// Lines of at most `width` characters, broken at blanks; within a word only if it is longer than a line. If
/// there are more than `most`, the last one ends with "...".
std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t most);

}  // namespace nplc::macreg
