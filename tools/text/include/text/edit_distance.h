#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace nplc::spelling {

/// How many letters are to be changed, added or left out to make the one name of the other, two neighbours
/// swapped being one change (optimal string alignment). Without regard to upper and lower case of ASCII.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first of the candidates that are nearest to `name`, if one is near enough to be what was meant: no
/// more than a third of the letters differ. Nothing otherwise.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace nplc::spelling
