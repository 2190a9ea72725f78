#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nplc::boards {

/// A sequence table of a file, raw or in Intel HEX, end term included; nothing else is in it.
struct TableFile {
    std::vector<std::uint8_t> bytes{};
    std::string error{};  ///< one line, which names the file and what to do; then there are no bytes
};
TableFile read_table(const std::string& path);

}  // namespace nplc::boards
