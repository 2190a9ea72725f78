#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nplc::sim {

/// Virtual time since power-up. Finer than the firmware's microseconds, so that line rates do not drift.
using Time = std::chrono::nanoseconds;

/// The whole text as a decimal number; no sign but a leading '-', no blanks, nothing behind it.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Digits with at most one point, `.` between digits; an optional leading '-'.
std::optional<double> parse_decimal(std::string_view text);

/// Number and unit: us, ms, s, min; blanks between them allowed (`5s`, `1.5 s`, `250 us`). Not negative; at
/// most 1,000,000 minutes.
std::optional<Time> parse_duration(std::string_view text);
/// `number` in the unit named; nothing if it names none or the result is out of the range above.
std::optional<Time> to_duration(double number, std::string_view unit);

/// `1%`, `0.5 %`: 0..100 percent as 0..1. The sign must be there.
std::optional<double> parse_percent(std::string_view text);

/// Milliseconds with three decimals: `12.250`.
std::string in_milliseconds(Time time);
/// As the user writes it: `250 us`, `1.5 ms`, `2 s`.
std::string in_words(Time time);

bool same_name(std::string_view a, std::string_view b);  ///< case counts not
std::string lower(std::string_view text);

/// For XML, in attributes too: characters with a meaning by their names, what is no character in UTF-8 as a
/// question mark.
std::string in_xml(std::string_view text);

/// Without blanks, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

}  // namespace nplc::sim
