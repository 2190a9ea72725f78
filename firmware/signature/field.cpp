#include "field.h"

namespace nplc::signature {
namespace {

using Digit = std::uint16_t;
using Digits = std::array<Digit, Field::kDigits>;

/// 2^256 is 38 modulo p. `carry`: the overflow of the digits, less than 2^16.
void fold(Digits& digits, std::uint32_t carry) {
    while (carry != 0) {
        carry *= 38;
        for (Digit& digit : digits) {
            carry += digit;
            digit = static_cast<Digit>(carry);
            carry >>= 16;
        }
    }
}

/// Subtracts `borrow` times 2^256, which is 38.
void fold_borrow(Digits& digits, std::uint32_t borrow) {
    while (borrow != 0) {
        borrow *= 38;
        for (Digit& digit : digits) {
            const std::uint32_t difference = digit - borrow;
            digit = static_cast<Digit>(difference);
            borrow = (difference >> 16) & 1U;
        }
    }
}

/// a^(2^250 - 1), with which both powers begin: its exponent is 250 ones.
Field power_of_ones(const Field& a) {
    Field power = a;
    for (unsigned ones = 1; ones < 250; ++ones) power = squared(power) * a;
    return power;
}

}  // namespace

Field operator+(const Field& a, const Field& b) {
    Field sum;
    std::uint32_t carry = 0;
    for (std::size_t i = 0; i < Field::kDigits; ++i) {
        carry += std::uint32_t{a.digits[i]} + b.digits[i];
        sum.digits[i] = static_cast<Digit>(carry);
        carry >>= 16;
    }
    fold(sum.digits, carry);
    return sum;
}

Field operator-(const Field& a, const Field& b) {
    Field result;
    std::uint32_t borrow = 0;
    for (std::size_t i = 0; i < Field::kDigits; ++i) {
        const std::uint32_t difference = std::uint32_t{a.digits[i]} - b.digits[i] - borrow;
        result.digits[i] = static_cast<Digit>(difference);
        borrow = (difference >> 16) & 1U;
    }
    fold_borrow(result.digits, borrow);
    return result;
}

/// (2^16 - 1)^2 and twice 2^16 - 1 just fill 32 bits.
Field operator*(const Field& a, const Field& b) {
    std::array<Digit, 2 * Field::kDigits> product{};
    for (std::size_t i = 0; i < Field::kDigits; ++i) {
        std::uint32_t carry = 0;
        const std::uint32_t factor = a.digits[i];
        for (std::size_t j = 0; j < Field::kDigits; ++j) {
            carry += product[i + j] + factor * b.digits[j];
            product[i + j] = static_cast<Digit>(carry);
            carry >>= 16;
        }
        product[i + Field::kDigits] = static_cast<Digit>(carry);
    }
    Field result;
    std::uint32_t carry = 0;
    for (std::size_t i = 0; i < Field::kDigits; ++i) {
        carry += product[i] + 38U * product[i + Field::kDigits];
        result.digits[i] = static_cast<Digit>(carry);
        carry >>= 16;
    }
    fold(result.digits, carry);
    return result;
}

/// a^(p - 2), and p - 2 = (2^250 - 1) * 2^5 + 01011b.
Field inverse(const Field& a) {
    const Field first = squared(squared(power_of_ones(a))) * a;
    const Field second = squared(squared(first)) * a;
    return squared(second) * a;
}

/// (p - 5) / 8 = (2^250 - 1) * 2^2 + 01b.
Field power_for_root(const Field& a) {
    return squared(squared(power_of_ones(a))) * a;
}

Field field_of(std::span<const std::uint8_t, kFieldBytes> bytes) {
    Field result;
    for (std::size_t i = 0; i < Field::kDigits; ++i)
        result.digits[i] = static_cast<Digit>(bytes[2 * i] | (bytes[2 * i + 1] << 8));
    result.digits.back() &= 0x7FFF;
    return result;
}

std::array<std::uint8_t, kFieldBytes> bytes_of(const Field& a) {
    Digits digits = a.digits;
    for (int i = 0; i < 2; ++i) {  // bit 255 is worth 19
        std::uint32_t carry = (digits.back() >> 15) * 19U;
        digits.back() &= 0x7FFF;
        for (Digit& digit : digits) {
            carry += digit;
            digit = static_cast<Digit>(carry);
            carry >>= 16;
        }
    }
    Digits less = digits;  // by p, which is adding 19 and taking off 2^255
    std::uint32_t carry = 19;
    for (Digit& digit : less) {
        carry += digit;
        digit = static_cast<Digit>(carry);
        carry >>= 16;
    }
    if ((less.back() & 0x8000) != 0) {
        less.back() &= 0x7FFF;
        digits = less;
    }
    std::array<std::uint8_t, kFieldBytes> bytes;
    for (std::size_t i = 0; i < Field::kDigits; ++i) {
        bytes[2 * i] = static_cast<std::uint8_t>(digits[i]);
        bytes[2 * i + 1] = static_cast<std::uint8_t>(digits[i] >> 8);
    }
    return bytes;
}

bool operator==(const Field& a, const Field& b) {
    return bytes_of(a) == bytes_of(b);
}

}  // namespace nplc::signature
