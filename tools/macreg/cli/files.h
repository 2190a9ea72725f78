#pragma once

#include <string>

#include "macreg/parameters.h"

namespace nplc::macreg::cli {

/// A file of `dump`, whole; throws UserError with the first problem's line, and how many more there are.
ParameterSet read_parameter_file(const std::string& path, bool partial);

}  // namespace nplc::macreg::cli
