#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::panel {

/// RFC 4648 §4, padded.
std::string to_base64(std::span<const std::uint8_t> bytes);
/// Empty if the text is invalid.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace nplc::panel
