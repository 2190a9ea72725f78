#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Words that people type, and lines of the files they write. ASCII only.
namespace nplc::spelling {

std::string lower(std::string_view text);
/// Without regard to upper and lower case.
bool is_same(std::string_view a, std::string_view b);
/// Without these characters at both ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");
/// What stands between the separators, trimmed; one at the least.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Nothing if there is anything else.
std::optional<std::int64_t> whole_number(std::string_view text, int base = 10);

}  // namespace nplc::spelling
