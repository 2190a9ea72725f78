#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nplc::sim {

/// Virtual time since power-up. Finer than the firmware's microseconds, so that line rates do not drift.
using Time = std::chrono::nanoseconds;

/// Parses the whole text as a decimal number; an optional leading '-', no blanks, no suffix.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Digits with at most one point, `.` between digits; an optional leading '-'.
std::optional<double> parse_decimal(std::string_view text);

/// Number and unit: us, ms, s, min; blanks between them allowed (`5s`, `1.5 s`, `250 us`). Not negative; at
/// most 1,000,000 minutes.
std::optional<Time> parse_duration(std::string_view text);
/// `number` in the named unit; empty if there is no such unit or the result is out of the range above.
std::optional<Time> to_duration(double number, std::string_view unit);

/// `1%`, `0.5 %`: 0..100 percent as 0..1. The percent sign is required.
std::optional<double> parse_percent(std::string_view text);

/// Milliseconds with three decimals: `12.250`.
std::string in_milliseconds(Time time);
/// As the user writes it: `250 us`, `1.5 ms`, `2 s`.
std::string in_words(Time time);

bool same_name(std::string_view a, std::string_view b);  ///< case-insensitive
std::string lower(std::string_view text);

/// Escapes text for XML, also in attributes; invalid UTF-8 becomes a question mark.
std::string in_xml(std::string_view text);

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trim(std::string_view text);

}  // namespace nplc::sim
