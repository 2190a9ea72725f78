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

/// The input of a subcommand.
struct InputFile {
    std::string file;
    std::string symbols{};  ///< path of F.sym; empty: the file next to a table is used if it fits
    bool is_whole = false;  ///< bytes after a table's end are refused, not ignored
};

/// A program or table, read from a file.
struct Input {
    std::string file;
    std::vector<std::uint8_t> table;     ///< whole terms, the end term last
    std::optional<Symbols> symbols;      ///< empty for a bare table without F.sym
    std::optional<Compilation> program;  ///< empty for a table
    std::optional<Sources> sources;      ///< the program's text
    int exit_code = kOk;                 ///< not kOk: the reason was printed, and the rest is empty
};

/// Compiles files that end in `.seq` and reads all others as tables, raw or Intel HEX. Prints errors on
/// standard error.
Input read_input(const InputFile& named);
inline Input read_input(const std::string& file) {
    return read_input(InputFile{.file = file});
}

/// `--symbols FILE`, in every subcommand that reads a table.
void add_symbols_option(arguments::App& command, InputFile& named);

/// A program or table that a gateway would accept; one with a term that every gateway refuses is a file
/// error. More terms than a gateway must hold are allowed.
Input read_for_view(const InputFile& named);

inline const Symbols* names_of(const Input& input) {
    return input.symbols ? &*input.symbols : nullptr;
}

}  // namespace nplc::seqc::cli
