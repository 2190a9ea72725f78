#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"

/// F.sym, which `seqc build` writes beside a table: the names of the program and where each term comes from,
/// as JSON. It belongs to one table, which it knows by size and CRC-32.
namespace nplc::seqc {

struct SymbolFile {
    Symbols symbols;
    std::string source;                           ///< the program's file, as the compiler was given it
    std::size_t table_bytes = 0;                  ///< the end term included
    std::uint32_t crc32 = 0;                      ///< of those bytes; base/crc32.h
    std::array<std::uint32_t, 63> step_lines{};   ///< by step number; 0: the compiler's own, or none
    std::array<std::uint8_t, 63> step_outputs{};  ///< bits of OUT0..OUT3 that are on in the step
    std::vector<Position> terms;                  ///< in table order, 0:0 for what the compiler adds
};

/// `file_name` is how the program was named. The compilation must be good.
std::string write_symbols(const Compilation& compilation, std::string_view source,
                          std::string_view file_name);
/// Lines of included files have the file's name beside them.
std::string write_symbols(const Compilation& compilation, const Sources& sources);

struct SymbolReading {
    SymbolFile file;
    std::string error;  ///< why there is nothing: what, and where in the file; empty when there is
};

/// Takes version 1; members that it does not know are read over.
SymbolReading read_symbols(std::string_view text);
/// The same for one table: the bytes up to and including the end term. Another table's symbols are an error.
SymbolReading read_symbols(std::string_view text, std::span<const std::uint8_t> table);

/// F.sym for F.bin; empty if `table_file` has that name itself.
std::string symbol_file_beside(std::string_view table_file);

}  // namespace nplc::seqc
