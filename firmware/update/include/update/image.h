#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "signature/ed25519.h"
#include "signature/sha512.h"

/// Header before an image in its slot and in its file. Little-endian.
///
///     0 magic "NPFW"  4 format 1  8 board  12 address  16 version  20 length  24 zeros  32 SHA-512 of the
///     image 96 Ed25519 signature of the bytes before it
namespace nplc::update {

inline constexpr std::size_t kSignedBytes = 96;
inline constexpr std::size_t kHeaderBytes = kSignedBytes + signature::kSignatureBytes;
inline constexpr std::uint32_t kImageAt = 256;  ///< the image's first byte, counted from the header's

struct ImageHeader {
    std::uint32_t board = 0;
    std::uint32_t address = 0;  ///< of the image's first byte in the chip: its link address
    std::uint32_t version = 0;  ///< major in bits 31..16, minor 15..8, patch 7..0
    std::uint32_t length = 0;   ///< of the image alone
    signature::Digest512 hash{};
    bool operator==(const ImageHeader&) const = default;
};

/// The signed bytes.
std::array<std::uint8_t, kSignedBytes> encode(const ImageHeader& header);
/// Empty if they are no header. The signature is not checked.
std::optional<ImageHeader> decode(std::span<const std::uint8_t, kSignedBytes> bytes);

}  // namespace nplc::update
