#include "store/layout.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::store {
namespace {

constexpr std::uint32_t kMagic = 0x7453504E;  // "NPSt"
constexpr std::uint32_t kDone = 0x454E4F44;   // "DONE"
constexpr std::uint8_t kFormat = 1;
constexpr std::size_t kChecked = kHeaderBytes - 4;

bool divides(std::uint32_t part, std::uint32_t whole) {
    return part != 0 && whole != 0 && whole % part == 0;
}

}  // namespace

std::array<std::uint8_t, kHeaderBytes> encode(const Header& header) {
    std::array<std::uint8_t, kHeaderBytes> bytes{};
    base::store_u32(&bytes[0], kMagic);
    bytes[4] = kFormat;
    bytes[5] = static_cast<std::uint8_t>(header.kind);
    base::store_u32(&bytes[8], header.sequence);
    base::store_u32(&bytes[12], header.length);
    base::store_u32(&bytes[16], header.crc);
    base::store_u32(&bytes[kChecked], base::crc32(std::span(bytes).first(kChecked)));
    return bytes;
}

std::array<std::uint8_t, kMarkBytes> mark_for(std::span<const std::uint8_t, kHeaderBytes> header) {
    std::array<std::uint8_t, kMarkBytes> bytes{};
    base::store_u32(&bytes[0], kDone);
    std::copy(header.begin() + kChecked, header.end(), bytes.begin() + 4);
    return bytes;
}

base::Result<Header> decode(std::span<const std::uint8_t, kHeaderBytes> bytes) {
    const bool sound = base::load_u32(&bytes[0]) == kMagic && bytes[4] == kFormat &&
                       base::load_u32(&bytes[kChecked]) == base::crc32(bytes.first(kChecked));
    if (!sound) return base::Error::damaged;
    return Header{.kind = static_cast<Kind>(bytes[5]),
                  .sequence = base::load_u32(&bytes[8]),
                  .length = base::load_u32(&bytes[12]),
                  .crc = base::load_u32(&bytes[16])};
}

bool Layout::is_possible() const {
    const auto& g = geometry_;
    return divides(g.program_unit, g.program_page) && divides(g.program_page, g.erase_block) &&
           divides(g.erase_block, g.size) && g.program_unit <= kLargestUnit &&
           divides(g.erase_block, area_.slot_bytes) && area_.begin % g.erase_block == 0 &&
           area_.begin <= g.size && (g.size - area_.begin) / 2 >= area_.slot_bytes &&
           superseded(0) > content(0);
}

std::uint32_t Layout::whole_units(std::size_t bytes) const {
    const std::uint32_t unit = geometry_.program_unit;
    return (static_cast<std::uint32_t>(bytes) + unit - 1) / unit * unit;
}

std::uint32_t Layout::one_programming(std::uint32_t address, std::uint32_t bytes) const {
    return std::min(bytes, geometry_.program_page - address % geometry_.program_page);
}

}  // namespace nplc::store
