#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "registers/family.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// A sequence ready to run.
struct Program {
    std::string file;
    std::vector<std::uint8_t> table;  ///< Table::load takes it
    /// As uploaded: the table, then the record of its set-points.
    std::vector<std::uint8_t> content() const;
    std::size_t terms = 0;
    std::uint32_t crc32 = 0;  ///< of the table with its end term
    std::string name;         ///< from the source; empty for a table without names
    Names names;
    const registers::DriveModel* drive = nullptr;  ///< as in Symbols
    std::string symbols_text;                      ///< content of F.sym; empty for a table without names
    std::string symbols;                           ///< the file with a table's names, or empty
    std::string nameless;  ///< one line for the user why a table's symbols were not used, or empty
    std::string remark;    ///< one line for the user about the source, or empty
};

/// `.seq` is compiled, any other file is read as a table. Its names come from `symbols`, which must fit, or
/// from the symbol file next to it if that fits. Throws InputError; for a source its message contains all of
/// the compiler's diagnostics.
Program load_program(const std::string& file, const std::optional<std::string>& symbols = {});
/// The symbol file that load_program would read for a table, existing or not; empty if none.
std::string symbols_of(const std::string& file, const std::optional<std::string>& symbols);

}  // namespace nplc::sim
