#include "sim/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace nplc::sim {
namespace {

constexpr double kLongestNs = 60e15;  // 1,000,000 minutes

struct Unit {
    std::string_view name;
    double nanoseconds;
};
constexpr std::array<Unit, 4> kUnits{{{"us", 1e3}, {"ms", 1e6}, {"s", 1e9}, {"min", 60e9}}};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

char lower_char(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Bytes of the character at the start of `text`; 0: invalid.
std::size_t length_of_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 && first < 0xF5 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
    if (length == 0 || first >= 0xF5 || text.size() < length) return 0;
    const std::string_view rest = text.substr(1, length - 1);
    const auto follows = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    return std::all_of(rest.begin(), rest.end(), follows) ? length : 0;
}

}  // namespace

std::optional<std::int64_t> parse_integer(std::string_view text) {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

std::optional<double> parse_decimal(std::string_view text) {
    const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
    if (digits.empty() || !is_digit(digits.front()) || !is_digit(digits.back())) return std::nullopt;
    const bool plain =
        std::all_of(digits.begin(), digits.end(), [](char c) { return is_digit(c) || c == '.'; });
    if (!plain || std::count(digits.begin(), digits.end(), '.') > 1) return std::nullopt;
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    return value;
}

std::optional<Time> to_duration(double number, std::string_view unit) {
    for (const Unit& known : kUnits) {
        if (!same_name(known.name, unit)) continue;
        const double nanoseconds = std::round(number * known.nanoseconds);
        if (nanoseconds < 0 || nanoseconds > kLongestNs) return std::nullopt;
        return Time{static_cast<std::int64_t>(nanoseconds)};
    }
    return std::nullopt;
}

std::optional<Time> parse_duration(std::string_view text) {
    const auto unit = std::find_if(text.begin(), text.end(), [](char c) { return !is_digit(c) && c != '.'; });
    const auto length = static_cast<std::size_t>(unit - text.begin());
    const auto number = parse_decimal(text.substr(0, length));
    if (!number) return std::nullopt;
    const auto name = std::min(text.find_first_not_of(' ', length), text.size());
    return to_duration(*number, text.substr(name));
}

std::optional<double> parse_percent(std::string_view text) {
    if (!text.ends_with('%')) return std::nullopt;
    const auto number = parse_decimal(trim(text.substr(0, text.size() - 1)));
    if (!number || *number < 0 || *number > 100) return std::nullopt;
    return *number / 100;
}

std::string in_milliseconds(Time time) {
    const std::int64_t microseconds = time.count() / 1000;
    return fmt::format("{}.{:03}", microseconds / 1000, microseconds % 1000);
}

std::string in_words(Time time) {
    const double ns = static_cast<double>(time.count());
    const Unit* best = &kUnits[0];
    for (const Unit& unit : kUnits) {
        if (unit.name != "min" && ns >= unit.nanoseconds) best = &unit;
    }
    return fmt::format("{:.10g} {}", ns / best->nanoseconds, best->name);
}

bool same_name(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower_char(x) == lower_char(y); });
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), lower_char);
    return result;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string in_xml(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = length_of_character(text);
        switch (length == 1 ? text.front() : '\0') {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += length == 0 ? "?" : text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

}  // namespace nplc::sim
