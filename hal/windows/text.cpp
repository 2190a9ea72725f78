#include "text.h"

#include <windows.h>

#include <system_error>

namespace nplc::hal_windows {

std::string error_text(unsigned long error) {
    std::string text = std::system_category().message(static_cast<int>(error));
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == '.'))
        text.pop_back();
    return text + " (" + std::to_string(error) + ")";
}

std::wstring wide(const std::string& text) {
    const int bytes = static_cast<int>(text.size());
    const int count = ::MultiByteToWideChar(CP_UTF8, 0, text.data(), bytes, nullptr, 0);
    std::wstring result(static_cast<std::size_t>(count), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, text.data(), bytes, result.data(), count);
    return result;
}

}  // namespace nplc::hal_windows
