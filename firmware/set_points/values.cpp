#include "set_points/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace nplc::set_points {
namespace {

/// Never with an exponent.
std::string plain_text(double number, int digits) {
    std::string text = fmt::format("{:.{}g}", number, digits);
    if (text.find('e') == text.npos) return text;
    text = fmt::format("{:.15f}", std::strtod(text.c_str(), nullptr));
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

/// The fewest digits that are read back as the same number of steps.
std::string shortest_text(const SetPoint& point, std::int32_t value) {
    const double exact = value / point.steps_per_unit;
    for (int digits = 1; digits < 17; ++digits) {
        std::string text = plain_text(exact, digits);
        if (std::llround(std::strtod(text.c_str(), nullptr) * point.steps_per_unit) == value) return text;
    }
    return plain_text(exact, 12);
}

/// From where the STEP counts, in the unit.
double first_of_grid(const SetPoint& point) {
    return point.grid_from ? *point.grid_from
                           : std::strtod(shortest_text(point, point.lowest).c_str(), nullptr);
}

/// The value of the STEP next to `number`, in the unit, without what adding up a fraction leaves.
double beside(const SetPoint& point, double number) {
    const double first = first_of_grid(point);
    const double next = first + std::round((number - first) / point.step) * point.step;
    return std::strtod(fmt::format("{:.10g}", next).c_str(), nullptr);
}

/// A tie goes to either side.
bool rounds_to(const SetPoint& point, double number, std::int32_t value) {
    return std::fabs(number * point.steps_per_unit - value) <= 0.5 + 1e-6;
}

std::string number_text(const SetPoint& point, std::int32_t value) {
    if (point.step <= 0) return shortest_text(point, value);
    const double written = beside(point, value / point.steps_per_unit);
    return rounds_to(point, written, value) ? plain_text(written, 10) : shortest_text(point, value);
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

}  // namespace

bool is_on_grid(const SetPoint& point, std::int32_t value) {
    return point.step <= 0 || rounds_to(point, beside(point, value / point.steps_per_unit), value);
}

std::string grid_beside(const SetPoint& point, std::int32_t value) {
    const double number = value / point.steps_per_unit;
    const double first = first_of_grid(point);
    const double below = beside(point, first + std::floor((number - first) / point.step) * point.step);
    const double above = beside(point, below + point.step);
    const std::string low = plain_text(below, 10);
    return above * point.steps_per_unit > point.highest + 0.5
               ? low
               : fmt::format("{} or {}", low, plain_text(above, 10));
}

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
        const auto shows = [power, &point](double number) {
            return std::fabs(number * power - std::round(number * power)) < 1e-4 * point.step * power;
        };
        if (point.step > 0) return shows(point.step) && shows(first_of_grid(point));
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

std::string short_text_of(const SetPoint& point, std::int32_t value) {
    return in_unit(shortest_text(point, value), point.unit);
}

std::string range_text(const SetPoint& point) {
    std::string text = fmt::format("{} to {}", text_of(point, point.lowest), text_of(point, point.highest));
    if (point.step > 0)
        text += fmt::format(" in steps of {}", in_unit(plain_text(point.step, 10), point.unit));
    return text;
}

Reading read_value(const SetPoint& point, std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::string limits = fmt::format("{} takes {}", point.name, range_text(point));
    const bool has_two_signs = digits.size() < text.size() && digits.starts_with('-');
    if (error != std::errc{} || !std::isfinite(number) || has_two_signs)
        return {0, fmt::format("'{}' is no value; {}", text, limits)};
    std::string_view unit(end, static_cast<std::size_t>(digits.data() + digits.size() - end));
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    const double factor = factor_of(point, unit);
    if (factor == 0) return {0, fmt::format("'{}' is no unit of {}; {}", unit, point.name, limits)};
    number *= factor;
    const double exact = number * point.steps_per_unit;
    if (exact < point.lowest - 0.5 || exact > point.highest + 0.5)
        return {0, fmt::format("{} is out of range; {}", in_unit(std::string(text), ""), limits)};
    if (point.kind == ValueKind::counter && exact != std::floor(exact))
        return {0, fmt::format("{} is no whole number; {}", text, limits)};
    const auto value = static_cast<std::int32_t>(
        std::clamp(std::round(exact), static_cast<double>(point.lowest), static_cast<double>(point.highest)));
    if (!is_on_grid(point, value)) {
        const std::string beside = grid_beside(point, value);
        const bool is_last = beside.find(' ') == beside.npos;
        return {0, fmt::format("{} is {}, {}; {}", text,
                               is_last ? "behind the last step" : "between two steps", beside, limits)};
    }
    return {value, {}};
}

}  // namespace nplc::set_points
