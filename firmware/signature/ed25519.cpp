#include "signature/ed25519.h"

#include <algorithm>
#include <optional>

#include "edwards.h"
#include "signature/sha512.h"

namespace nplc::signature {
namespace {

/// A number below 2^256, the lowest byte first.
using Scalar = std::array<std::uint8_t, 32>;

/// L = 2^252 + 27742317777372353535851937790883648493
constexpr Scalar kOrder{0xED, 0xD3, 0xF5, 0x5C, 0x1A, 0x63, 0x12, 0x58, 0xD6, 0x9C, 0xF7,
                        0xA2, 0xDE, 0xF9, 0xDE, 0x14, 0,    0,    0,    0,    0,    0,
                        0,    0,    0,    0,    0,    0,    0,    0,    0,    0x10};

bool is_below_order(const Scalar& scalar) {
    return std::lexicographical_compare(scalar.rbegin(), scalar.rend(), kOrder.rbegin(), kOrder.rend());
}

bool bit_of(std::span<const std::uint8_t> bytes, std::size_t bit) {
    return ((unsigned{bytes[bit / 8]} >> (bit % 8)) & 1U) != 0;
}

/// 2 * scalar + bit, less than 2 L.
void shift_in(Scalar& scalar, bool bit) {
    unsigned carry = bit ? 1 : 0;
    for (std::uint8_t& byte : scalar) {
        carry |= unsigned{byte} << 1;
        byte = static_cast<std::uint8_t>(carry);
        carry >>= 8;
    }
}

void subtract_order(Scalar& scalar) {
    unsigned borrow = 0;
    for (std::size_t i = 0; i < scalar.size(); ++i) {
        const unsigned difference = unsigned{scalar[i]} - kOrder[i] - borrow;
        scalar[i] = static_cast<std::uint8_t>(difference);
        borrow = (difference >> 8) & 1U;
    }
}

Scalar modulo_order(const Digest512& number) {
    Scalar rest{};
    for (std::size_t bit = 8 * number.size(); bit-- > 0;) {
        shift_in(rest, bit_of(number, bit));
        if (!is_below_order(rest)) subtract_order(rest);
    }
    return rest;
}

/// s B + h A, both scalars bit by bit in one loop.
Point combined(const Scalar& s, const Scalar& h, const Point& a, Meanwhile meanwhile) {
    const Point both = kBase + a;
    Point sum = kNeutral;
    for (std::size_t bit = 8 * s.size(); bit-- > 0;) {
        meanwhile();
        sum = doubled(sum);
        const bool with_base = bit_of(s, bit);
        const bool with_a = bit_of(h, bit);
        if (with_base && with_a) {
            sum = sum + both;
        } else if (with_base || with_a) {
            sum = sum + (with_base ? kBase : a);
        }
    }
    return sum;
}

}  // namespace

bool is_signed(std::span<const std::uint8_t> message, const Signature& signature, const PublicKey& key,
               Meanwhile meanwhile) {
    PointBytes r;
    Scalar s;
    std::copy_n(signature.begin(), r.size(), r.begin());
    std::copy_n(signature.begin() + r.size(), s.size(), s.begin());
    if (!is_below_order(s)) return false;
    meanwhile();
    const std::optional<Point> a = point_of(key);
    if (!a) return false;
    Sha512 hash;
    hash.add(r);
    hash.add(key);
    hash.add(message);
    meanwhile();
    return bytes_of(combined(s, modulo_order(hash.end()), -*a, meanwhile)) == r;
}

}  // namespace nplc::signature
