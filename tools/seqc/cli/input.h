#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/common.h"
#include "seqc/seqc.h"

namespace nplc::seqc::cli {

/// A program or a table from a file, ready to be looked at.
struct Input {
    std::string file;
    std::vector<std::uint8_t> table;     ///< whole terms, the end term last
    std::optional<Symbols> symbols;      ///< nothing for a bare table
    std::optional<Compilation> program;  ///< nothing for a table
    std::string source;                  ///< the program's text
    int exit_code = kOk;                 ///< not kOk: why was printed, and the rest is empty
};

/// Compiles what ends in `.seq` and reads all else as a table. Prints what is wrong with it on standard
/// error.
Input read_input(const std::string& file);

}  // namespace nplc::seqc::cli
