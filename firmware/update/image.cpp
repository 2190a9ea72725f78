#include "update/image.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::update {
namespace {

constexpr std::uint32_t kMagic = 0x5746504E;  // "NPFW"
constexpr std::uint32_t kFormat = 1;
constexpr std::size_t kHashAt = 32;

}  // namespace

std::array<std::uint8_t, kSignedBytes> encode(const ImageHeader& header) {
    std::array<std::uint8_t, kSignedBytes> bytes{};
    base::store_u32(&bytes[0], kMagic);
    base::store_u32(&bytes[4], kFormat);
    base::store_u32(&bytes[8], header.board);
    base::store_u32(&bytes[12], header.address);
    base::store_u32(&bytes[16], header.version);
    base::store_u32(&bytes[20], header.length);
    std::copy(header.hash.begin(), header.hash.end(), bytes.begin() + kHashAt);
    return bytes;
}

std::optional<ImageHeader> decode(std::span<const std::uint8_t, kSignedBytes> bytes) {
    if (base::load_u32(&bytes[0]) != kMagic || base::load_u32(&bytes[4]) != kFormat) return std::nullopt;
    ImageHeader header{.board = base::load_u32(&bytes[8]),
                       .address = base::load_u32(&bytes[12]),
                       .version = base::load_u32(&bytes[16]),
                       .length = base::load_u32(&bytes[20])};
    std::copy(bytes.begin() + kHashAt, bytes.end(), header.hash.begin());
    return header;
}

}  // namespace nplc::update
