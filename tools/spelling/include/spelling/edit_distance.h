#pragma once

#include <cstddef>
#include <string_view>

namespace nplc::spelling {

/// How many letters are to be changed, added or left out to make the one name of the other, two neighbours
/// swapped being one change (optimal string alignment). Without regard to upper and lower case of ASCII.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace nplc::spelling
