#include <utility>

#include "exact.h"
#include "registers/convert.h"
#include "registers/names.h"
#include "registers/scale.h"

namespace nplc::registers {
namespace {

using std::string_view;

/// Maximum number of digits that fit in 60 bits.
constexpr int most_digits(int base) {
    return base == 2 ? 60 : base == 16 ? 15 : 18;
}
constexpr int kMostDecimals = 9;

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

constexpr int digit_of(char c) {
    if (is_digit(c)) return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return 99;
}

string_view without_blanks(string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

struct Digits {
    std::int64_t value = 0;
    int count = 0;
    int significant = 0;
};

/// Takes digits, with single `_` between them, off the front of `text`.
Digits take_digits(string_view& text, int base, Digits digits = {}) {
    for (bool after_digit = false; !text.empty(); text.remove_prefix(1)) {
        if (text.front() == '_' && after_digit && text.size() > 1 && digit_of(text[1]) < base) {
            after_digit = false;
            continue;
        }
        const int digit = digit_of(text.front());
        if (digit >= base) break;
        after_digit = true;
        ++digits.count;
        if (digits.value != 0 || digit != 0) ++digits.significant;
        if (digits.significant <= most_digits(base)) digits.value = digits.value * base + digit;
    }
    return digits;
}

Parsed failure(TextError error) {
    return {.error = error};
}

Parsed in_range(Parsed parsed, const Register& reg) {
    if (parsed.raw < reg.min || parsed.raw > reg.max) parsed.error = TextError::out_of_range;
    return parsed;
}

Parsed parse_bits(string_view text, int base, const Register& reg) {
    const Digits bits = take_digits(text, base);
    if (bits.count == 0) return failure(TextError::not_a_number);
    if (!text.empty())
        return failure(is_blank(text.front()) ? TextError::wrong_unit : TextError::not_a_number);
    if (bits.significant > most_digits(base)) return failure(TextError::too_long);
    const std::int64_t most = is_32_bit(reg.format) ? 0xFFFF'FFFF : 0xFFFF;
    if (bits.value > most) return {.error = TextError::out_of_range, .raw = bits.value};
    return in_range({.raw = value_of(reg.format, static_cast<std::uint32_t>(bits.value))}, reg);
}

Parsed in_steps(std::int64_t mantissa, int decimals, Ratio factor, const Register& reg) {
    std::int64_t divisor = factor.denominator;
    for (int i = 0; i < decimals; ++i) divisor *= 10;
    const Quotient q = divide_product(mantissa, factor.numerator, divisor);
    if (!q.fits) return failure(TextError::out_of_range);
    Parsed parsed{.raw = q.value, .exact = q.remainder == 0};
    parsed.rounding = static_cast<std::int16_t>(divide_product(-q.remainder, 1000, divisor).value);
    if (q.value == 0 && mantissa != 0) parsed.error = TextError::too_small;
    return parsed.error == TextError::none ? in_range(parsed, reg) : parsed;
}

}  // namespace

Parsed parse(string_view text, const Register& reg, Model model) {
    text = without_blanks(text);
    for (const auto& [prefix, base] : {std::pair{string_view("16#"), 16}, {"8#", 8}, {"2#", 2}}) {
        if (text.starts_with(prefix)) return parse_bits(text.substr(prefix.size()), base, reg);
    }
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    Digits number = take_digits(text, 10);
    if (number.count == 0) return failure(TextError::not_a_number);
    int decimals = 0;
    if (text.starts_with('.')) {
        text.remove_prefix(1);
        const int before = number.count;
        number = take_digits(text, 10, number);
        decimals = number.count - before;
        if (decimals == 0) return failure(TextError::not_a_number);
    }
    if (number.significant > most_digits(10) || decimals > kMostDecimals) return failure(TextError::too_long);
    text = without_blanks(text);
    if (text.find_first_of("0123456789.#_") == 0) return failure(TextError::not_a_number);
    const auto factor = raw_per_unit(reg, model, text);
    if (!factor) return failure(TextError::wrong_unit);
    return in_steps(negative ? -number.value : number.value, decimals, *factor, reg);
}

}  // namespace nplc::registers
