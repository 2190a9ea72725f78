#pragma once

#include <string>

#include "config.h"

namespace nplc::boards {

/// What is to be joined to what, as a table for the electrician.
std::string wiring(const Config& config);

}  // namespace nplc::boards
