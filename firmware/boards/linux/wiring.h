#pragma once

#include <string>

#include "config.h"

namespace nplc::boards {

/// What is to be joined to what, as a table for a person with a screwdriver.
std::string wiring(const Config& config);

}  // namespace nplc::boards
