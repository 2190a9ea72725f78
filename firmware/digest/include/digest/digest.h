#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// SHA-256 of certificates, and of ordered tables.
namespace nplc::digest {

using Digest = std::array<std::uint8_t, 32>;

/// Whether this program was built with libmd. Without it sha256() returns zeros.
bool is_available();
inline constexpr std::string_view kNotAvailable =
    "this program was built without libmd, which certificates need; take the one of another system";

Digest sha256(std::span<const std::uint8_t> bytes);
Digest sha256(std::string_view text);

/// Lower case.
std::string hex(std::span<const std::uint8_t> bytes);
/// Lower case; the length must fit `out` exactly.
bool read_hex(std::string_view text, std::span<std::uint8_t> out);

}  // namespace nplc::digest
