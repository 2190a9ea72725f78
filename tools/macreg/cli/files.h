#pragma once

#include <string>

#include "macreg/parameters.h"

namespace nplc::macreg::cli {

/// A file of `dump`, whole, - is standard input; throws Failure with every line that is wrong.
ParameterSet read_parameter_file(const std::string& path, bool partial);

/// All of standard input; Ctrl-C ends the program meanwhile. Throws UserError.
std::string read_standard_input();

/// "a MAC800", "one of MAC50 to MAC141"
std::string model_words(const ParameterSet& set);

}  // namespace nplc::macreg::cli
