#pragma once

#include <string>

#include "config.h"

namespace nplc::boards {

/// The wiring table for the electrician.
std::string wiring(const Config& config);

}  // namespace nplc::boards
