#pragma once

#include <string>
#include <vector>

#include "cli/session.h"
#include "set_points/dropped.h"

namespace nplc::nanoctl::cli {

/// A line each, with a line feed before it.
std::string lines_of(const std::vector<set_points::Dropped>& dropped);
/// A list of `name`, `value`, `recipe` and `why`.
Json json_of(const std::vector<set_points::Dropped>& dropped);

}  // namespace nplc::nanoctl::cli
