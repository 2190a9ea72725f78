#pragma once

#include <string>
#include <string_view>

namespace nplc::host {

/// Bytes of the UTF-8 character at the start of `text`; 0 if there is none.
std::size_t character_length(std::string_view text);

/// Makes a user's text safe for a terminal: each control character and each invalid UTF-8 byte becomes '?'.
/// Tabs are kept.
std::string printable(std::string_view text);
/// The same, with line ends kept.
std::string printable_lines(std::string_view text);

/// Writes a message, possibly of several lines, to standard error: printable, lines cut at 1,000 bytes. A
/// write error is ignored.
void complain(std::string_view message);

}  // namespace nplc::host
