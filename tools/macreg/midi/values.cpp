#include "macreg/midi/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "registers/midi_scale.h"
#include "text/text.h"

namespace nplc::macreg::midi {

namespace reg = registers::midi;
using registers::Ratio;

namespace {

constexpr Choice kOnOff[] = {{0, "off"}, {1, "on"}};
constexpr Choice kStops[] = {{0, "none"}, {1, "hardware"}, {8, "software"}, {9, "both"}};
constexpr Choice kStopTorque[] = {{0, "nominal"}, {1, "standby"}};

// clang-format off
constexpr Parameter kParameters[] = {
    {.name = "POSITION", .sort = Sort::position, .title = "Where the shaft is", .query = reg::GET_POSITION},
    {.name = "STATUS", .sort = Sort::status, .title = "Faults, warnings, end-stops", .query = reg::GET_STATUS},
    {.name = "SPEED", .sort = Sort::period, .title = "Full speed of moves", .query = reg::GET_SPEEDS, .field = 1, .command = reg::SPEED},
    {.name = "RAMP", .sort = Sort::ramp, .title = "Length of a ramp, from standstill to full speed", .query = reg::GET_SETTINGS, .field = 0, .command = reg::RAMP},
    {.name = "UNSTALL", .sort = Sort::long_period, .title = "Speed at which what is missing at the end of a move is made up", .query = reg::GET_SPEEDS, .field = 0, .command = reg::UNSTALL},
    {.name = "TORQUE", .sort = Sort::torque, .title = "Limit of the torque", .query = reg::GET_SETTINGS, .field = 1, .command = reg::TORQUE},
    {.name = "STOP_TORQUE", .sort = Sort::choice, .title = "Torque at standstill: all of it, or half", .query = reg::GET_SETTINGS, .field = 2, .command = reg::STOP_TORQUE, .choices = kStopTorque},
    {.name = "TOLERANCE", .sort = Sort::tolerance, .title = "How far from its target a move counts as done", .query = reg::GET_SETTINGS, .field = 4, .command = reg::TOLERANCE},
    {.name = "END_STOPS", .sort = Sort::choice, .title = "Which end-stops act", .query = reg::GET_SETTINGS, .field = 3, .command = reg::END_STOPS, .choices = kStops},
    {.name = "UPPER_STOP", .sort = Sort::position, .title = "Upper software end-stop", .query = reg::GET_UPPER_STOP, .command = reg::UPPER_STOP},
    {.name = "LOWER_STOP", .sort = Sort::position, .title = "Lower software end-stop", .query = reg::GET_LOWER_STOP, .command = reg::LOWER_STOP},
    {.name = "REFERENCE", .sort = Sort::choice, .title = "The reference input sets the position to 0; cannot be read, off after each start", .command = reg::REFERENCE, .choices = kOnOff},
    {.name = "TEMPERATURE", .sort = Sort::temperature, .title = "Temperature", .query = reg::GET_MEASURES, .field = 0},
    {.name = "SUPPLY", .sort = Sort::supply, .title = "Supply voltage", .query = reg::GET_MEASURES, .field = 1},
    {.name = "TERMINALS", .sort = Sort::terminals, .title = "End-stop and reference inputs, and whether it follows", .query = reg::GET_MEASURES, .field = 2},
    {.name = "IMAX", .sort = Sort::number, .title = "What TORQUE has at full torque (RAM AFh)", .query = reg::GET_RAM, .sub_index = reg::kImaxAddress},
    {.name = "RELEASE", .sort = Sort::release, .title = "Software release", .query = reg::GET_RELEASE},
};
// clang-format on

constexpr std::size_t kMostDigits = 12;

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
    return wrong(fmt::format(
        "'{}': turns need the model; say --model MAC23, MAC34-1 or MAC34-2, or write increments (inc)",
        text));
}

std::int64_t increments(Model model) {
    return reg::facts_of(model).increments_per_rev;
}

/// Increments/s in one of the unit; nullopt if it is no unit of speed.
std::optional<Ratio> speed_unit(const std::string& unit, std::optional<Model> model, bool& wants_model) {
    if (unit == "inc/s") return Ratio{1, 1};
    if (unit != "rpm" && unit != "rev/s") return std::nullopt;
    wants_model = !model;
    if (!model) return std::nullopt;
    return Ratio{increments(*model), 1} / Ratio{unit == "rpm" ? 60 : 1, 1};
}

TypedNumber whole(std::string_view text, const Quantity& quantity, const Ratio& factor) {
    const Ratio size = quantity.size * factor;
    const auto value = nearest(size);
    if (!value) return wrong(fmt::format("'{}' is too much", text));
    return {.value = quantity.negative ? -*value : *value, .exact = size.denominator == 1};
}

double increments_of(const Scale& scale) {
    return reg::facts_of(*scale.model).increments_per_rev;
}

/// Four significant digits, without trailing zeros.
std::string short_number(double value) {
    std::string text = fmt::format("{:.2f}", value);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string rate_text(double increments_per_second, const Scale& scale) {
    const std::string plain = short_number(increments_per_second) + " inc/s";
    if (!scale.model) return plain;
    return fmt::format("{} rpm ({})", short_number(increments_per_second * 60 / increments_of(scale)), plain);
}

std::string ramp_text(std::int64_t raw, const Scale& scale) {
    if (raw == 0) return "0 inc (as fast as the torque allows)";
    const std::string length = fmt::format("{} inc", raw * reg::kRampIncrements);
    if (scale.period == 0) return length;
    const double speed = static_cast<double>(reg::kTicksPerSecond) / static_cast<double>(scale.period);
    const double rate = speed * speed / (2.0 * reg::kRampIncrements * static_cast<double>(raw));
    const std::string turns =
        scale.model ? fmt::format(", {} rev/s2", short_number(rate / increments_of(scale))) : std::string();
    return fmt::format("{} ({} inc/s2{})", length, short_number(rate), turns);
}

std::string name_of_choice(const Parameter& parameter, std::int64_t raw) {
    for (const Choice& one : parameter.choices) {
        if (one.value == raw) return std::string(one.name);
    }
    return fmt::format("{}", raw);
}

std::string bit_words(std::span<const reg::Bit> bits, std::uint32_t value) {
    std::string text;
    for (const reg::Bit& bit : bits) {
        if ((value & bit.mask) != 0) text += fmt::format("{}{}", text.empty() ? "" : "; ", bit.text);
    }
    return text;
}

TypedNumber typed_choice(const Parameter& parameter, std::string_view text) {
    for (const Choice& one : parameter.choices) {
        if (text == one.name || text == fmt::format("{}", one.value)) return {.value = one.value};
    }
    return wrong(fmt::format("'{}': write {}", text, units_text(parameter)));
}

/// A raw value, typed as `raw:N`.
TypedNumber typed_raw(std::string_view text) {
    const auto quantity = read_quantity(text);
    if (!quantity || !quantity->unit.empty() || quantity->size.denominator != 1)
        return wrong(fmt::format("'raw:{}' is no whole number", text));
    return {.value = quantity->negative ? -quantity->size.numerator : quantity->size.numerator};
}

/// The next slower one.
TypedNumber typed_unstall(std::string_view text, const Scale& scale) {
    const TypedNumber rate = typed_rate(text, scale.model, false);
    if (!rate.error.empty()) return rate;
    const auto raw = reg::unstall_of_speed(static_cast<std::uint32_t>(rate.value));
    if (!raw) return wrong(fmt::format("'{}': it is 20 to 5000 inc/s", text));
    return {.value = *raw,
            .exact = rate.exact && rate.value * *raw * reg::kTicksPerLongPeriod == reg::kTicksPerSecond};
}

/// By an acceleration, which is one from full speed.
TypedNumber typed_ramp_rate(std::string_view text, const Scale& scale) {
    if (scale.period == 0)
        return wrong(fmt::format("'{}': an acceleration needs the speed; write inc or rev", text));
    const TypedNumber rate = typed_rate(text, scale.model, true);
    if (!rate.error.empty()) return rate;
    const auto speed = static_cast<std::uint32_t>(reg::kTicksPerSecond / scale.period);
    const auto raw = reg::ramp_of(speed, static_cast<std::uint32_t>(rate.value));
    if (raw) return {.value = *raw, .exact = false};
    return wrong(fmt::format("'{}' takes more than the 30600 inc of the longest ramp from SPEED's {}", text,
                             speed_text(scale.period, scale)));
}

TypedNumber typed_ramp(std::string_view text, const Scale& scale) {
    const auto quantity = read_quantity(text);
    if (quantity && quantity->unit.ends_with("/s2")) return typed_ramp_rate(text, scale);
    TypedNumber number = typed_position(text, scale.model);
    number.exact = number.exact && number.value % reg::kRampIncrements == 0;
    number.value = (number.value + reg::kRampIncrements - 1) / reg::kRampIncrements;
    return number;
}

TypedNumber typed_torque(std::string_view text, const Scale& scale) {
    const auto quantity = read_quantity(text);
    if (!quantity || quantity->negative || quantity->unit != "%")
        return wrong(fmt::format("'{}': write a number and %, or raw:N", text));
    const Ratio part = quantity->size * Ratio{scale.imax, 1} / Ratio{100, 1};
    if (part.numerator > scale.imax * part.denominator)
        return wrong(fmt::format("'{}' is more than all of it", text));
    return {.value = part.numerator / part.denominator, .exact = part.denominator == 1};
}

TypedNumber typed_number(const Parameter& parameter, std::string_view text, const Scale& scale) {
    if (text.starts_with("raw:")) return typed_raw(text.substr(4));
    switch (parameter.sort) {
        case Sort::choice:
            return typed_choice(parameter, text);
        case Sort::period:
            return typed_period(text, scale.model);
        case Sort::long_period:
            return typed_unstall(text, scale);
        case Sort::ramp:
            return typed_ramp(text, scale);
        case Sort::torque:
            return typed_torque(text, scale);
        default:
            return typed_position(text, scale.model);
    }
}

}  // namespace

std::span<const Parameter> parameters() {
    return kParameters;
}

const Parameter* find_parameter(std::string_view name) {
    const auto* found =
        std::find_if(std::begin(kParameters), std::end(kParameters),
                     [name](const Parameter& one) { return spelling::is_same(one.name, name); });
    return found == std::end(kParameters) ? nullptr : found;
}

std::int64_t raw_in(const Parameter& parameter, std::uint32_t reply) {
    if (parameter.sub_index == reg::kImaxAddress) return reply >> 24;
    const reg::Field& field = reg::find_query(*parameter.query)->fields[parameter.field];
    const std::int32_t value = reg::unpack(field, reply);
    return field.bits == 32 && !field.is_signed ? std::int64_t{static_cast<std::uint32_t>(value)} : value;
}

const reg::CommandRow& row_of(const Parameter& parameter) {
    return *reg::find_command(*parameter.command);
}

std::uint32_t data_for(const Parameter& parameter, std::int64_t raw) {
    return reg::pack(row_of(parameter), static_cast<std::int32_t>(raw)).value_or(0);
}

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
    quantity.unit = spelling::lower(rest);
    return quantity;
}

std::optional<std::uint8_t> read_address(std::string_view text) {
    const auto quantity = read_quantity(text);
    const bool is_one = quantity && quantity->unit.empty() && !quantity->negative &&
                        quantity->size.denominator == 1 && quantity->size.numerator <= 0x7F;
    return is_one ? std::optional(static_cast<std::uint8_t>(quantity->size.numerator)) : std::nullopt;
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
    const Ratio size = quantity->size * Ratio{factor, 1};
    return {.value = size.numerator / size.denominator, .exact = size.numerator % size.denominator == 0};
}

std::string position_text(std::int64_t position, const Scale& scale) {
    if (!scale.model) return fmt::format("{} inc", position);
    return fmt::format("{} inc ({:.4f} rev)", position, static_cast<double>(position) / increments_of(scale));
}

std::string speed_text(std::int64_t period, const Scale& scale) {
    if (period == 0) return "none";
    return rate_text(static_cast<double>(reg::kTicksPerSecond) / static_cast<double>(period), scale);
}

std::string status_words(std::uint32_t status) {
    return bit_words(reg::status_bits(), status);
}

std::string terminal_words(std::uint32_t terminals) {
    const std::string inputs = bit_words(reg::terminal_bits(), terminals & ~std::uint32_t{reg::kNotBusy});
    const std::string follows = (terminals & reg::kNotBusy) != 0 ? "follows" : "busy: not where it is to be";
    return inputs.empty() ? follows : follows + "; on: " + inputs;
}

std::string release_text(std::uint32_t release) {
    return fmt::format("{:X}.{:X}", release >> 8, release & 0xFF);
}

std::string value_text(const Parameter& parameter, std::int64_t raw, const Scale& scale) {
    const auto bits = static_cast<std::uint32_t>(raw);
    switch (parameter.sort) {
        case Sort::position:
            return position_text(raw, scale);
        case Sort::tolerance:
            return fmt::format("{} inc", raw);
        case Sort::period:
            return speed_text(raw, scale);
        case Sort::long_period:
            return speed_text(raw * reg::kTicksPerLongPeriod, scale);
        case Sort::ramp:
            return ramp_text(raw, scale);
        case Sort::torque:
            if (scale.imax == 0) return fmt::format("{}", raw);
            // Rounded up: input is rounded down, so the shown value is read back as the same.
            return short_number(static_cast<double>((raw * 10'000 + scale.imax - 1) / scale.imax) / 100) +
                   " %";
        case Sort::choice:
            return name_of_choice(parameter, raw);
        case Sort::temperature:
            if (!scale.model) return fmt::format("{} (degrees need --model)", raw);
            return fmt::format("{:.1f} C",
                               reg::temperature_of(*scale.model, static_cast<std::uint8_t>(raw)) / 1000.0);
        case Sort::supply:
            if (!scale.model) return fmt::format("{} (volts need --model)", raw);
            return fmt::format("{:.1f} V",
                               reg::supply_of(*scale.model, static_cast<std::uint8_t>(raw)) / 1000.0);
        case Sort::status: {
            const std::string words = status_words(bits);
            return words.empty() ? "no fault, no warning" : words;
        }
        case Sort::terminals:
            return terminal_words(bits);
        case Sort::release:
            return release_text(bits);
        case Sort::number:
            break;
    }
    return fmt::format("{}", raw);
}

TypedValue typed_value(const Parameter& parameter, std::string_view text, const Scale& scale) {
    TypedValue typed;
    if (!parameter.command) {
        typed.error = fmt::format("{} is read only", parameter.name);
        return typed;
    }
    const TypedNumber number = typed_number(parameter, text, scale);
    typed.raw = number.value;
    const reg::Field& field = row_of(parameter).fields[0];
    const std::int64_t most = parameter.sort == Sort::torque ? scale.imax : std::int64_t{field.max};
    const bool fits = typed.raw >= field.min && typed.raw <= most &&
                      reg::pack(row_of(parameter), static_cast<std::int32_t>(typed.raw));
    if (!number.error.empty())
        typed.error = fmt::format("{}: {}", parameter.name, number.error);
    else if (!fits)
        typed.error =
            fmt::format("{}: '{}' is out of range: {} to {}", parameter.name, text,
                        value_text(parameter, field.min, scale), value_text(parameter, most, scale));
    else if (!number.exact)
        typed.rounding =
            fmt::format("{}: {} taken as {}", parameter.name, text, value_text(parameter, typed.raw, scale));
    return typed;
}

std::string units_text(const Parameter& parameter) {
    if (!parameter.command) return {};
    switch (parameter.sort) {
        case Sort::period:
        case Sort::long_period:
            return "rpm, rev/s, inc/s";
        case Sort::ramp:
            return "inc, rev, inc/s2, rev/s2";
        case Sort::torque:
            return "%";
        case Sort::tolerance:
        case Sort::position:
            return "inc, rev";
        default:
            break;
    }
    std::string text;
    for (const Choice& one : parameter.choices)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", one.name);
    return text;
}

}  // namespace nplc::macreg::midi
