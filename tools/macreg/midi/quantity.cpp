#include "macreg/midi/quantity.h"

#include <fmt/format.h>

#include <cctype>
#include <limits>

#include "registers/midi_scale.h"

namespace nplc::macreg::midi {

namespace reg = registers::midi;
using registers::Ratio;

namespace {

constexpr std::size_t kMostDigits = 12;

std::string lower(std::string_view text) {
    std::string result;
    for (const char c : text) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::optional<Quantity> read_hex(std::string_view digits) {
    if (digits.empty() || digits.size() > 8) return std::nullopt;
    std::int64_t value = 0;
    for (const char c : digits) {
        if (std::isxdigit(static_cast<unsigned char>(c)) == 0) return std::nullopt;
        value = value * 16 + (is_digit(c) ? c - '0' : std::tolower(static_cast<unsigned char>(c)) - 'a' + 10);
    }
    return Quantity{.size = {value, 1}};
}

Ratio reduced(std::int64_t numerator, std::int64_t denominator) {
    const std::int64_t common = std::gcd(numerator, denominator);
    return {numerator / common, denominator / common};
}

TypedNumber wrong(std::string error) {
    TypedNumber number;
    number.error = std::move(error);
    return number;
}

TypedNumber no_number(std::string_view text, std::string_view units) {
    return wrong(fmt::format("'{}': write a number and {}", text, units));
}

TypedNumber needs_model(std::string_view text) {
    return wrong(
        fmt::format("'{}': turns need the model; say --model MAC23, MAC34-1 or MAC34-2, or write "
                    "increments (inc)",
                    text));
}

std::int64_t increments(Model model) {
    return reg::facts_of(model).increments_per_rev;
}

/// Increments a second that one of the unit is; nothing if it is no speed.
std::optional<Ratio> speed_unit(const std::string& unit, std::optional<Model> model, bool& wants_model) {
    if (unit == "inc/s") return Ratio{1, 1};
    if (unit != "rpm" && unit != "rev/s") return std::nullopt;
    wants_model = !model;
    if (!model) return std::nullopt;
    return Ratio{increments(*model), 1} / Ratio{unit == "rpm" ? 60 : 1, 1};
}

TypedNumber whole(std::string_view text, const Quantity& quantity, const Ratio& factor) {
    const Ratio size = quantity.size.numerator == 0 ? Ratio{0, 1} : quantity.size * factor;
    const auto value = nearest(size);
    if (!value) return wrong(fmt::format("'{}' is too much", text));
    return {.value = quantity.negative ? -*value : *value, .exact = size.denominator == 1};
}

}  // namespace

std::optional<Quantity> read_quantity(std::string_view text) {
    std::string packed;
    for (const char c : text) {
        if (c != ' ' && c != '\t') packed += c;
    }
    std::string_view rest = packed;
    if (rest.starts_with("0x") || rest.starts_with("0X")) return read_hex(rest.substr(2));
    Quantity quantity;
    if (!rest.empty() && (rest[0] == '-' || rest[0] == '+')) {
        quantity.negative = rest[0] == '-';
        rest.remove_prefix(1);
    }
    std::int64_t digits = 0;
    std::int64_t divisor = 1;
    std::size_t count = 0;
    bool point = false;
    for (; !rest.empty() && (is_digit(rest[0]) || (rest[0] == '.' && !point)); rest.remove_prefix(1)) {
        if (rest[0] == '.') {
            point = true;
            continue;
        }
        digits = digits * 10 + (rest[0] - '0');
        if (point) divisor *= 10;
        if (++count > kMostDigits) return std::nullopt;
    }
    if (count == 0) return std::nullopt;
    quantity.size = reduced(digits, divisor);
    quantity.unit = lower(rest);
    return quantity;
}

std::optional<std::int64_t> nearest(const Ratio& ratio) {
    const std::int64_t value = ratio.numerator / ratio.denominator;
    if (value > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
    const std::int64_t rest = ratio.numerator % ratio.denominator;
    return value + (2 * rest >= ratio.denominator ? 1 : 0);
}

TypedNumber typed_position(std::string_view text, std::optional<Model> model) {
    const auto quantity = read_quantity(text);
    if (!quantity) return no_number(text, "inc or rev behind it");
    if (quantity->unit.empty() || quantity->unit == "inc") return whole(text, *quantity, {1, 1});
    if (quantity->unit != "rev")
        return wrong(fmt::format("'{}': a position is in inc or rev, not '{}'", text, quantity->unit));
    if (!model) return needs_model(text);
    return whole(text, *quantity, {increments(*model), 1});
}

TypedNumber typed_period(std::string_view text, std::optional<Model> model) {
    const auto quantity = read_quantity(text);
    if (!quantity) return no_number(text, "rpm, rev/s or inc/s behind it");
    bool wants_model = false;
    const auto unit = speed_unit(quantity->unit, model, wants_model);
    if (wants_model) return needs_model(text);
    if (!unit)
        return wrong(fmt::format("'{}': a speed is in rpm, rev/s or inc/s, not '{}'", text, quantity->unit));
    if (quantity->size.numerator == 0)
        return wrong(fmt::format("'{}': no speed at all; `macreg midi stop` stops", text));
    const Ratio period = Ratio{reg::kTicksPerSecond, 1} / (quantity->size * *unit);
    const auto ticks = nearest(period);
    // Faster and slower ones would round to the ends.
    if (!ticks || period.numerator > 0xFFFF * period.denominator || period.numerator < period.denominator)
        return wrong(fmt::format("'{}': a module turns at 122.1 to 8000000 inc/s (period 65535 to 1)", text));
    return {.value = quantity->negative ? -*ticks : *ticks, .exact = period.denominator == 1};
}

TypedNumber typed_rate(std::string_view text, std::optional<Model> model, bool squared) {
    const std::string_view units = squared ? "inc/s2 or rev/s2 behind it" : "rpm, rev/s or inc/s behind it";
    const auto quantity = read_quantity(text);
    if (!quantity || quantity->negative) return no_number(text, units);
    std::string unit = quantity->unit;
    if (squared && unit.size() > 2 && unit.ends_with("2")) unit.pop_back();
    if (squared == (unit == quantity->unit)) return no_number(text, units);
    bool wants_model = false;
    const auto factor = speed_unit(unit, model, wants_model);
    if (wants_model) return needs_model(text);
    if (!factor) return no_number(text, units);
    return whole(text, *quantity, *factor);
}

TypedNumber typed_time(std::string_view text) {
    const auto quantity = read_quantity(text);
    if (!quantity || quantity->negative) return no_number(text, "ms, s or min behind it");
    std::int64_t factor = 0;
    if (quantity->unit == "ms") factor = 1'000;
    if (quantity->unit.empty() || quantity->unit == "s") factor = 1'000'000;
    if (quantity->unit == "min") factor = 60'000'000;
    if (factor == 0) return no_number(text, "ms, s or min behind it");
    const Ratio size = quantity->size.numerator == 0 ? Ratio{0, 1} : quantity->size * Ratio{factor, 1};
    return {.value = size.numerator / size.denominator, .exact = size.numerator % size.denominator == 0};
}

}  // namespace nplc::macreg::midi
