#include "macreg/wrap.h"

#include <algorithm>

namespace nplc::macreg {

std::vector<std::string> wrapped(std::string_view text, std::size_t width, std::size_t most) {
    constexpr std::string_view kMore = "...";
    std::vector<std::string> lines;
    if (width <= kMore.size() || most == 0) return lines;
    while (!text.empty()) {
        if (lines.size() == most) {
            std::string& last = lines.back();
            last = last.substr(0, width - kMore.size()).append(kMore);
            break;
        }
        std::size_t length = std::min(width, text.size());
        if (length < text.size()) {
            const std::size_t blank = text.rfind(' ', length);
            if (blank != std::string_view::npos && blank > 0) length = blank;
        }
        lines.emplace_back(text.substr(0, length));
        text.remove_prefix(length);
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    }
    return lines;
}

}  // namespace nplc::macreg
