#pragma once

#include <cstdint>
#include <string_view>

namespace nplc::panel {

/// `text` is a symbol file as `seqc build` writes it, and for the table of this CRC-32.
bool is_for_table(std::string_view text, std::uint32_t crc);

}  // namespace nplc::panel
