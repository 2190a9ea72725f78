#pragma once

#include <numeric>

#include "registers/mac.h"

namespace nplc::registers {

/// An exact factor, reduced; both parts positive.
struct Ratio {
    std::int64_t numerator = 1;
    std::int64_t denominator = 1;

    friend constexpr bool operator==(const Ratio&, const Ratio&) = default;
    /// Cross-reduced first, so that the products stay small.
    friend constexpr Ratio operator*(const Ratio& a, const Ratio& b) {
        const std::int64_t ab = std::gcd(a.numerator, b.denominator);
        const std::int64_t ba = std::gcd(b.numerator, a.denominator);
        return {a.numerator / ab * (b.numerator / ba), a.denominator / ba * (b.denominator / ab)};
    }
    friend constexpr Ratio operator/(const Ratio& a, const Ratio& b) {
        return a * Ratio{b.denominator, b.numerator};
    }
};

/// Encoder and sample rate, exactly (001 §3.2.5, §3.2.144; 004 registers 5 and 12, computed).
struct ExactScale {
    std::int64_t counts_per_rev;
    Ratio samples_per_second;
};
ExactScale exact_scale_of(Model model);

/// The number 1 in a format: 1, or 256 for Fixed8 (001 §3.1, 004).
std::int64_t one_in(Format format);

/// Raw steps of the register per `unit`, exactly; empty if the unit does not fit it. Case-insensitive, blanks
/// are ignored. No unit is the raw step itself, and in fixed-point registers the number 1.
///
/// Lengths `counts`, `rev`; speeds `rpm` or a length with `/s`; accelerations a speed with `/s` or a length
/// with
/// `/s2`; torque `%peak` (100 % = 1023, 001 §3.2.7; plain `%` is the same) and `%nominal` (300 % = 1023, 004
/// register 7); `samples`, `ms`, `s`; `V`, `mV`; `C` or `°C`; `eldeg`, electrical degrees. `none` and `bits`
/// take no unit.
std::optional<Ratio> raw_per_unit(const Register& reg, Model model, std::string_view unit);

/// The usual units for such a register, the most common first; none for a plain number.
std::span<const std::string_view> units_of(Unit unit);

}  // namespace nplc::registers
