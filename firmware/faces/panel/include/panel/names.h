#pragma once

#include <cstdint>
#include <string_view>

namespace nplc::panel {

/// Whether `text` is a symbol file as written by `seqc build`, for the table with this CRC-32.
bool is_for_table(std::string_view text, std::uint32_t crc);

}  // namespace nplc::panel
