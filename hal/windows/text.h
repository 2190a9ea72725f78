#pragma once

#include <string>

namespace nplc::hal_windows {

/// The text of a Windows error number, in one line.
std::string error_text(unsigned long error);

/// Conversion between UTF-8 and Windows' wide strings.
std::wstring wide(const std::string& text);

}  // namespace nplc::hal_windows
