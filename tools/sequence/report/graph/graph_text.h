#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// For text in "...": quotes and backslashes escaped.
std::string quoted(std::string_view text);

/// For labels in <...>: markup escaped, invalid UTF-8 and unprintable characters replaced.
std::string markup(std::string_view text);

/// Lines of about `width` characters, broken only before AND and OR and after commas and semicolons; before
/// every OR if one line is not enough.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

}  // namespace nplc::seqc
