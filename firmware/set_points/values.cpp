#include "set_points/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace nplc::set_points {
namespace {

/// The fewest digits that convert back to the same raw value.
std::string number_text(const SetPoint& point, std::int32_t value) {
    const double exact = value / point.steps_per_unit;
    for (int digits = 1; digits < 17; ++digits) {
        std::string text = fmt::format("{:.{}g}", exact, digits);
        const double back = std::strtod(text.c_str(), nullptr);
        if (std::llround(back * point.steps_per_unit) == value && text.find('e') == text.npos) return text;
    }
    return fmt::format("{:.12g}", exact);
}

std::string in_unit(const std::string& number, const std::string& unit) {
    return unit.empty() ? number : number + " " + unit;
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Set-point units per `unit`; 0: not a unit of it.
double factor_of(const SetPoint& point, std::string_view unit) {
    const std::string written = lower(unit);
    const std::string own = lower(point.unit);
    if (written.empty() || written == own) return 1;
    if (point.kind != ValueKind::timer) return 0;
    const double milliseconds = written == "ms" ? 1 : written == "s" ? 1000 : 0;
    return milliseconds / (own == "s" ? 1000 : 1);
}

/// The multiples of STEP next to `number`, in the unit.
std::string steps_beside(const SetPoint& point, double number, double low) {
    const double below = low + std::floor((number - low) / point.step) * point.step;
    return fmt::format("{:.10g} or {:.10g}", below, below + point.step);
}

bool is_on_step(const SetPoint& point, double number, double low) {
    const double steps = (number - low) / point.step;
    return std::fabs(steps - std::round(steps)) < 1e-4 * std::max(1.0, std::fabs(steps) * 1e-3);
}

}  // namespace

double shown_value(const SetPoint& point, std::int32_t value) {
    return std::strtod(number_text(point, value).c_str(), nullptr);
}

std::optional<std::int32_t> steps_of(const SetPoint& point, double number) {
    const double exact = std::round(number * point.steps_per_unit);
    if (!(exact >= INT32_MIN && exact <= INT32_MAX)) return std::nullopt;
    return static_cast<std::int32_t>(exact);
}

unsigned decimals_of(const SetPoint& point) {
    constexpr unsigned kMost = 6;
    unsigned digits = 0;
    const auto is_enough = [&point](double power) {
        if (point.step > 0)
            return std::fabs(point.step * power - std::round(point.step * power)) < 1e-4 * point.step * power;
        return power >= point.steps_per_unit;
    };
    while (digits < kMost && !is_enough(std::pow(10, digits))) ++digits;
    const double largest = std::max(std::fabs(point.lowest / point.steps_per_unit),
                                    std::fabs(point.highest / point.steps_per_unit));
    while (digits > 0 && largest * std::pow(10, digits) > INT32_MAX) --digits;
    return digits;
}

std::string text_of(const SetPoint& point, std::int32_t value) {
    return in_unit(number_text(point, value), point.unit);
}

std::string range_text(const SetPoint& point) {
    std::string text = fmt::format("{} to {}", text_of(point, point.lowest), text_of(point, point.highest));
    if (point.step > 0)
        text += fmt::format(" in steps of {}", in_unit(fmt::format("{:g}", point.step), point.unit));
    return text;
}

Reading read_value(const SetPoint& point, std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::string limits = fmt::format("{} takes {}", point.name, range_text(point));
    if (error != std::errc{} || !std::isfinite(number))
        return {0, fmt::format("'{}' is no value; {}", text, limits)};
    std::string_view unit(end, static_cast<std::size_t>(digits.data() + digits.size() - end));
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    const double factor = factor_of(point, unit);
    if (factor == 0) return {0, fmt::format("'{}' is no unit of {}; {}", unit, point.name, limits)};
    number *= factor;
    const double exact = number * point.steps_per_unit;
    if (exact < point.lowest - 0.5 || exact > point.highest + 0.5)
        return {0, fmt::format("{} is out of range; {}", in_unit(std::string(text), ""), limits)};
    const double low = std::strtod(number_text(point, point.lowest).c_str(), nullptr);
    if (point.kind == ValueKind::counter && exact != std::floor(exact))
        return {0, fmt::format("{} is no whole number; {}", text, limits)};
    if (point.step > 0 && !is_on_step(point, number, low)) {
        return {0, fmt::format("{} is between two steps, {}; {}", text, steps_beside(point, number, low),
                               limits)};
    }
    const double rounded =
        std::clamp(std::round(exact), static_cast<double>(point.lowest), static_cast<double>(point.highest));
    return {static_cast<std::int32_t>(rounded), {}};
}

}  // namespace nplc::set_points
