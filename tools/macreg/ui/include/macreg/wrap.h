#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::macreg {

/// Lines of at most `width` characters, broken at blanks; within a word only if it is longer than a line. If
/// there are more than `most`, the last one ends with "...".
std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t most);

}  // namespace nplc::macreg
