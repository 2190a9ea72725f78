#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arguments/arguments.h"
#include "cli/common.h"
#include "cli/input.h"
#include "seqc/seqc.h"

namespace nplc::seqc::cli {

/// What a subcommand reads.
struct InputFile {
    std::string file;
    std::string symbols{};  ///< F.sym by name; without one, the file beside a table is taken if it fits
    bool is_whole = false;  ///< bytes behind a table's end are refused, not left out
};

/// A program or a table from a file, ready to be looked at.
struct Input {
    std::string file;
    std::vector<std::uint8_t> table;     ///< whole terms, the end term last
    std::optional<Symbols> symbols;      ///< nothing for a bare table without F.sym
    std::optional<Compilation> program;  ///< nothing for a table
    std::optional<Sources> sources;      ///< the program's text
    int exit_code = kOk;                 ///< not kOk: why was printed, and the rest is empty
};

/// Compiles what ends in `.seq` and reads all else as a table, raw or Intel HEX. Prints what is wrong with it
/// on standard error.
Input read_input(const InputFile& named);
inline Input read_input(const std::string& file) {
    return read_input(InputFile{.file = file});
}

/// `--symbols FILE`, the same in every subcommand that takes a table.
void add_symbols_option(arguments::App& command, InputFile& named);

/// A program or table as a gateway would take it; one that every gateway refuses for a term of it is a file
/// problem. More terms than a gateway need hold are not.
Input read_for_view(const InputFile& named);

inline const Symbols* names_of(const Input& input) {
    return input.symbols ? &*input.symbols : nullptr;
}

}  // namespace nplc::seqc::cli
