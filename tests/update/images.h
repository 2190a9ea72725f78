#pragma once

#include <vector>

#include "ports/storage.h"
#include "signed_headers.h"
#include "update/layout.h"

/// Firmware of the tests and of the fuzz target: small images behind signed headers.
namespace nplc::update {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint32_t kBoard = 1;
inline constexpr std::uint32_t kSlotBytes = 4096;
inline constexpr std::uint32_t kBytes = 300;  ///< of an image

/// Header and image, as they go into a slot.
inline Bytes firmware(unsigned version, unsigned slot, const HeaderBytes& header) {
    Bytes bytes(header.begin(), header.end());
    bytes.resize(kImageAt, 0xFF);
    for (std::uint32_t i = 0; i < kBytes; ++i)
        bytes.push_back(static_cast<std::uint8_t>(i * 3 + version * 7 + slot));
    return bytes;
}

/// Versions 1 to 4.
inline Bytes firmware(unsigned version, unsigned slot) {
    return firmware(version, slot, kHeaders[version - 1][slot]);
}

}  // namespace nplc::update
