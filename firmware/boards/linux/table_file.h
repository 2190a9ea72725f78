#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nplc::boards {

/// A sequence table from a file, raw or Intel HEX, with its end term and nothing else.
struct TableFile {
    std::vector<std::uint8_t> bytes{};  ///< as uploaded: with the record of its set-points, if it has any
    std::string error{};  ///< one line with the file's name and the remedy; then there are no bytes
};
/// `symbols`: its symbol file; empty: the one in the same folder, if it belongs to this table.
TableFile read_table(const std::string& path, const std::string& symbols);

/// Of the table alone, end term included, as TABLE_CRC; empty if the file holds none.
std::optional<std::uint32_t> crc_of_table(const std::string& path);

}  // namespace nplc::boards
