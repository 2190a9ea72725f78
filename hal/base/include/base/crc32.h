#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace nplc::base {

inline constexpr std::array<std::uint32_t, 16> kCrc32OfHalfByte{
    0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
    0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C, 0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};

/// CRC-32 of IEEE 802.3, as in zlib, PNG and Ethernet: polynomial 04C11DB7h, reflected, initial value and
/// final XOR FFFFFFFFh. Check value of "123456789": CBF43926h. To continue with more bytes, pass the result
/// so far. The table takes 64 bytes: half a byte at a time.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t so_far = 0) {
    std::uint32_t crc = ~so_far;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        crc = (crc >> 4) ^ kCrc32OfHalfByte[crc & 0xFU];
        crc = (crc >> 4) ^ kCrc32OfHalfByte[crc & 0xFU];
    }
    return ~crc;
}

}  // namespace nplc::base
