#pragma once

#include <string>

namespace nplc::hal_windows {

/// What Windows says of one of its error numbers, in one line.
std::string error_text(unsigned long error);

/// Between UTF-8 and what Windows' functions take.
std::wstring wide(const std::string& text);

}  // namespace nplc::hal_windows
