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

/// A message, of several lines perhaps, on standard error: printable, and no line without end. That it cannot
/// be written is nobody's matter any more.
void complain(std::string_view message);

}  // namespace nplc::host
