#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// Numbers modulo p = 2^255 - 19. Between two operations they are below 2^256, not always below p.
namespace nplc::signature {

struct Field {
    static constexpr std::size_t kDigits = 16;
    std::array<std::uint16_t, kDigits> digits{};  ///< the lowest first
};

inline constexpr std::size_t kFieldBytes = 32;

Field operator+(const Field& a, const Field& b);
Field operator-(const Field& a, const Field& b);
Field operator*(const Field& a, const Field& b);
inline Field squared(const Field& a) {
    return a * a;
}
/// 1 / a; 0 of 0.
Field inverse(const Field& a);
/// a^((p - 5) / 8), used for square roots.
Field power_for_root(const Field& a);

/// The lowest byte first; bit 255 is ignored. A value not below p is reduced modulo p.
Field field_of(std::span<const std::uint8_t, kFieldBytes> bytes);
/// Below p.
std::array<std::uint8_t, kFieldBytes> bytes_of(const Field& a);
bool operator==(const Field& a, const Field& b);

}  // namespace nplc::signature
