#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nplc::boards {

/// A sequence table of a file, raw or in Intel HEX, end term included; nothing else is in the file.
struct TableFile {
    std::vector<std::uint8_t>
        bytes{};          ///< as it is uploaded: with the record of its set-points, if it has some
    std::string error{};  ///< one line, which names the file and what to do; then there are no bytes
};
/// `symbols`: its symbol file; empty: the one beside it, if there is one for this table.
TableFile read_table(const std::string& path, const std::string& symbols);

}  // namespace nplc::boards
