#pragma once

#include <array>
#include <cstdint>

namespace nplc::base {

/// A frame of classic CAN.
struct CanFrame {
    std::uint32_t id = 0;                ///< 0..7FFh; if extended 0..1FFFFFFFh
    bool extended = false;               ///< 29 bits of identifier instead of 11
    bool remote = false;                 ///< asks for a frame; has a length and no data
    std::uint8_t length = 0;             ///< 0..8
    std::array<std::uint8_t, 8> data{};  ///< 0 from `length` on

    bool operator==(const CanFrame&) const = default;
};

constexpr bool is_valid(const CanFrame& frame) {
    return frame.id <= (frame.extended ? 0x1FFF'FFFFU : 0x7FFU) && frame.length <= frame.data.size();
}

}  // namespace nplc::base
