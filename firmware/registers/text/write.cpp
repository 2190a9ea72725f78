#include "exact.h"
#include "registers/convert.h"
#include "registers/scale.h"

namespace nplc::registers {
namespace {

constexpr int kMostDecimals = 9;

void add_hex(Text& text, std::uint32_t bits, int digits) {
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
        text.add("0123456789ABCDEF"[(bits >> shift) & 0xF]);
}

/// `scaled` is the number times 10 to the power of `decimals`. Trailing zeros are omitted.
void add_decimal(Text& text, std::int64_t scaled, int decimals) {
    if (scaled < 0) text.add('-');
    while (decimals > 0 && scaled % 10 == 0) {
        scaled /= 10;
        --decimals;
    }
    std::array<char, 20> digits{};  // in reverse order
    std::size_t count = 0;
    auto rest = static_cast<std::uint64_t>(scaled < 0 ? -scaled : scaled);
    for (; rest != 0 || count <= static_cast<std::size_t>(decimals); rest /= 10) {
        digits[count++] = static_cast<char>('0' + rest % 10);
    }
    while (count > 0) {
        if (count == static_cast<std::size_t>(decimals)) text.add('.');
        text.add(digits[--count]);
    }
}

}  // namespace

std::int64_t value_of(Format format, std::uint32_t bits) {
    if (is_32_bit(format)) return static_cast<std::int32_t>(bits);
    if (format == Format::word) return static_cast<std::uint16_t>(bits);
    return static_cast<std::int16_t>(bits);
}

std::uint32_t bits_of(Format format, std::int64_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return is_32_bit(format) ? bits : bits & 0xFFFF;
}

Text to_text(std::int64_t raw, const Register& reg, Model model) {
    if (reg.unit != Unit::bits) {
        const auto units = units_of(reg.unit);
        return to_text(raw, reg, model, units.empty() ? std::string_view() : units.front());
    }
    Text text;
    text.add("16#");
    add_hex(text, bits_of(reg.format, raw), is_32_bit(reg.format) ? 8 : 4);
    return text;
}

Text to_text(std::int64_t raw, const Register& reg, Model model, std::string_view unit) {
    auto factor = raw_per_unit(reg, model, unit);
    if (!factor) {
        unit = {};
        factor = Ratio{one_in(reg.format), 1};
    }
    int decimals = 0;
    std::int64_t power = 1;
    for (; decimals < kMostDecimals && power * factor->denominator < 10 * factor->numerator; ++decimals)
        power *= 10;
    Text text;
    add_decimal(text, divide_product(raw, factor->denominator * power, factor->numerator).value, decimals);
    if (!unit.empty()) text.add(' ');
    text.add(unit);
    return text;
}

}  // namespace nplc::registers
