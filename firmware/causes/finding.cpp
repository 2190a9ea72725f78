#include "causes/finding.h"

#include <algorithm>

namespace nplc::causes {

std::string filled(std::string_view text, std::string_view first,
                   const std::function<std::string(std::string_view)>& word) {
    std::string result;
    for (;;) {
        const std::size_t open = text.find('{');
        result += text.substr(0, open);
        if (open == std::string_view::npos) return result;
        const std::size_t close = text.find('}', open);
        std::string key(text.substr(open + 1, close - open - 1));
        if (key.ends_with('*')) key.replace(key.size() - 1, 1, first);
        result += word(key);
        text.remove_prefix(close + 1);
    }
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

bool only_tell(std::span<const Finding> findings) {
    return std::all_of(findings.begin(), findings.end(),
                       [](const Finding& one) { return one.severity == Severity::tells; });
}

}  // namespace nplc::causes
