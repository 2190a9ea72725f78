#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// SHA-256 of certificates, and of tables that are ordered.
namespace nplc::digest {

using Digest = std::array<std::uint8_t, 32>;

/// Whether this program was built with libmd. Without it sha256() answers zeros.
bool is_available();
inline constexpr std::string_view kNotAvailable =
    "this program was built without libmd, which certificates need; take the one of another system";

Digest sha256(std::span<const std::uint8_t> bytes);
Digest sha256(std::string_view text);

/// Lower case.
std::string hex(std::span<const std::uint8_t> bytes);
/// Lower case, exactly as many as fit `out`.
bool read_hex(std::string_view text, std::span<std::uint8_t> out);

}  // namespace nplc::digest
