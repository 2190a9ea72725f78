#include "base/crc32.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace nplc::base {
namespace {

std::uint32_t crc_of(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return crc32(bytes);
}

/// The definition, bit by bit: divide by the reflected polynomial EDB88320h.
std::uint32_t by_definition(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
    }
    return ~crc;
}

// The check value that the catalogues of CRCs give for CRC-32/ISO-HDLC.
constexpr std::array<std::uint8_t, 9> kCheck{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
static_assert(crc32(kCheck) == 0xCBF43926);
static_assert(crc32({}) == 0);

TEST(Crc32, KnownValues) {
    EXPECT_EQ(crc_of("a"), 0xE8B7BE43U);
    EXPECT_EQ(crc_of("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
    // PNG's empty IEND chunk ends in AE 42 60 82, the CRC of its four letters.
    EXPECT_EQ(crc_of("IEND"), 0xAE426082U);
}

TEST(Crc32, EveryByteAsByDefinition) {
    for (unsigned value = 0; value < 256; ++value) {
        const std::array<std::uint8_t, 1> byte{static_cast<std::uint8_t>(value)};
        EXPECT_EQ(crc32(byte), by_definition(byte)) << value;
    }
}

TEST(Crc32, GoesOnWhereItStopped) {
    const std::span<const std::uint8_t> all(kCheck);
    for (std::size_t cut = 0; cut <= all.size(); ++cut) {
        EXPECT_EQ(crc32(all.subspan(cut), crc32(all.first(cut))), 0xCBF43926U) << cut;
    }
}

}  // namespace
}  // namespace nplc::base
