#pragma once

#include <string>
#include <string_view>

namespace nplc::host {

/// Bytes of the UTF-8 character that `text` begins with; 0 if it begins with none.
std::size_t character_length(std::string_view text);

/// Text of a user's for a terminal: control characters and what is no UTF-8 show as '?', one for each. Tabs
/// stay.
std::string printable(std::string_view text);
/// The same, and line ends stay.
std::string printable_lines(std::string_view text);

/// Writes a message, of several lines perhaps, to standard error: printable, lines of over 1,000 bytes cut
/// off. A failure to write is ignored.
void complain(std::string_view message);

}  // namespace nplc::host
