#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nplc::proof {

using Digest = std::array<std::uint8_t, 32>;

/// Whether this program was built with libmd. Without it nothing else of this folder may be called.
bool is_available();
inline constexpr std::string_view kNotAvailable =
    "this program was built without libmd, which certificates need; take the one of another system";

Digest sha256(std::span<const std::uint8_t> bytes);
Digest sha256(std::string_view text);
/// 64 digits, lower case.
std::string hex(std::span<const std::uint8_t> digest);

}  // namespace nplc::proof
