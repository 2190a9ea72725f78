#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/names.h"

namespace nplc::sim {

/// A sequence ready to run.
struct Program {
    std::string file;
    std::vector<std::uint8_t> table;  ///< Table::load takes it
    std::size_t terms = 0;
    Names names;
    std::string remark;  ///< one line for the user about the source, or empty
};

/// `.seq` is compiled, anything else is read as a raw table. Throws InputError; for a source its message
/// holds all of the compiler's diagnostics.
Program load_program(const std::string& file);

}  // namespace nplc::sim
