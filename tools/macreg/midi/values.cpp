#include "macreg/midi/values.h"

#include <fmt/format.h>

#include <cmath>

#include "macreg/midi/quantity.h"
#include "registers/midi_scale.h"

namespace nplc::macreg::midi {

using registers::Ratio;

namespace {

double increments_of(const Scale& scale) {
    return reg::facts_of(*scale.model).increments_per_rev;
}

/// Four digits that count, without zeros behind the point.
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

TypedValue wrong_value(std::string error) {
    TypedValue value;
    value.error = std::move(error);
    return value;
}

TypedValue typed_choice(const Parameter& parameter, std::string_view text) {
    for (const Choice& one : parameter.choices) {
        if (text == one.name || text == fmt::format("{}", one.value)) return {.raw = one.value};
    }
    return wrong_value(fmt::format("{}: '{}': write {}", parameter.name, text, units_text(parameter)));
}

/// A command's own number.
TypedValue typed_raw(const Parameter& parameter, std::string_view text) {
    const auto quantity = read_quantity(text);
    if (!quantity || !quantity->unit.empty() || quantity->size.denominator != 1)
        return wrong_value(fmt::format("{}: 'raw:{}' is no whole number", parameter.name, text));
    return {.raw = quantity->negative ? -quantity->size.numerator : quantity->size.numerator};
}

/// The next slower one.
TypedValue typed_unstall(const Parameter& parameter, std::string_view text, const Scale& scale) {
    const TypedNumber rate = typed_rate(text, scale.model, false);
    if (!rate.error.empty()) return wrong_value(fmt::format("{}: {}", parameter.name, rate.error));
    const auto raw = reg::unstall_of_speed(static_cast<std::uint32_t>(rate.value));
    if (!raw) return wrong_value(fmt::format("{}: '{}': it is 20 to 5000 inc/s", parameter.name, text));
    const bool exact = rate.exact && rate.value * *raw * reg::kTicksPerLongPeriod == reg::kTicksPerSecond;
    return {.raw = *raw, .rounding = exact ? "" : "not exact"};
}

TypedValue typed_ramp(const Parameter& parameter, std::string_view text, const Scale& scale) {
    const auto quantity = read_quantity(text);
    const bool is_rate = quantity && quantity->unit.ends_with("/s2");
    if (is_rate && scale.period == 0)
        return wrong_value(
            fmt::format("{}: '{}': an acceleration needs the speed; write inc or rev", parameter.name, text));
    const TypedNumber number =
        is_rate ? typed_rate(text, scale.model, true) : typed_position(text, scale.model);
    if (!number.error.empty()) return wrong_value(fmt::format("{}: {}", parameter.name, number.error));
    if (is_rate) {
        const auto speed = static_cast<std::uint32_t>(reg::kTicksPerSecond / scale.period);
        const auto raw = reg::ramp_of(speed, static_cast<std::uint32_t>(number.value));
        if (!raw)
            return wrong_value(
                fmt::format("{}: '{}' takes more than the 30600 inc of the longest ramp from SPEED's {}",
                            parameter.name, text, speed_text(scale.period, scale)));
        return {.raw = *raw, .rounding = "not exact"};
    }
    const std::int64_t raw = (number.value + reg::kRampIncrements - 1) / reg::kRampIncrements;
    return {.raw = raw,
            .rounding = number.value % reg::kRampIncrements == 0 && number.exact ? "" : "not exact"};
}

TypedValue typed_torque(const Parameter& parameter, std::string_view text, const Scale& scale) {
    const auto quantity = read_quantity(text);
    if (!quantity || quantity->negative || quantity->unit != "%")
        return wrong_value(fmt::format("{}: '{}': write a number and %, or raw:N", parameter.name, text));
    const Ratio part =
        quantity->size.numerator == 0 ? Ratio{0, 1} : quantity->size * Ratio{scale.imax, 1} / Ratio{100, 1};
    if (part.numerator > scale.imax * part.denominator)
        return wrong_value(fmt::format("{}: '{}' is more than all of it", parameter.name, text));
    return {.raw = part.numerator / part.denominator, .rounding = part.denominator == 1 ? "" : "not exact"};
}

TypedValue typed_in_units(const Parameter& parameter, std::string_view text, const Scale& scale) {
    const auto from = [&](const TypedNumber& number) {
        if (!number.error.empty()) return wrong_value(fmt::format("{}: {}", parameter.name, number.error));
        return TypedValue{.raw = number.value, .rounding = number.exact ? "" : "not exact"};
    };
    switch (parameter.sort) {
        case Sort::choice:
            return typed_choice(parameter, text);
        case Sort::position:
        case Sort::tolerance:
            return from(typed_position(text, scale.model));
        case Sort::period:
            return from(typed_period(text, scale.model));
        case Sort::long_period:
            return typed_unstall(parameter, text, scale);
        case Sort::ramp:
            return typed_ramp(parameter, text, scale);
        case Sort::torque:
            return typed_torque(parameter, text, scale);
        default:
            return wrong_value(fmt::format("{} is read only", parameter.name));
    }
}

}  // namespace

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
            // Rounded up: what is typed is rounded down, and so comes back the same.
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
    if (!parameter.command) return wrong_value(fmt::format("{} is read only", parameter.name));
    TypedValue typed = text.starts_with("raw:") ? typed_raw(parameter, text.substr(4))
                                                : typed_in_units(parameter, text, scale);
    if (!typed.error.empty()) return typed;
    const reg::Field& field = row_of(parameter).fields[0];
    const std::int64_t most = parameter.sort == Sort::torque ? scale.imax : std::int64_t{field.max};
    const bool fits = typed.raw >= field.min && typed.raw <= most &&
                      reg::pack(row_of(parameter), static_cast<std::int32_t>(typed.raw));
    if (!fits)
        return wrong_value(fmt::format("{}: '{}' is out of range: {} to {}", parameter.name, text,
                                       value_text(parameter, field.min, scale),
                                       value_text(parameter, most, scale)));
    if (!typed.rounding.empty())
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
