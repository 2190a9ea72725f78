#include "host/printable.h"

#include <algorithm>
#include <cstdio>

namespace nplc::host {
namespace {

constexpr std::size_t kLongestLine = 1000;

bool continues_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character.front());
    const bool is_c1 = first == 0xC2 && static_cast<unsigned char>(character.back()) < 0xA0;
    return (first < 0x20 && first != '\t') || first == 0x7F || is_c1;
}

std::string whole(std::string_view line) {
    return printable(line);
}

std::string shortened(std::string_view line) {
    std::string text = printable(line);
    if (text.size() <= kLongestLine) return text;
    std::size_t end = kLongestLine;
    while (continues_character(text[end])) --end;
    text.resize(end);
    return text + "...";
}

/// Applies `shown` to each line and keeps the line ends.
std::string lines_of(std::string_view text, std::string (*shown)(std::string_view)) {
    std::string result;
    for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
        result += shown(text.substr(0, end)) + '\n';
    return result + shown(text);
}

}  // namespace

std::size_t character_length(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length > text.size()) return 0;
    const std::string_view rest = text.substr(1, std::max<std::size_t>(length, 1) - 1);
    return std::all_of(rest.begin(), rest.end(), continues_character) ? length : 0;
}

std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0 || is_control(text.substr(0, length))) {
            result += '?';
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

std::string printable_lines(std::string_view text) {
    return lines_of(text, whole);
}

void complain(std::string_view message) {
    std::string text = lines_of(message, shortened);
    if (!text.ends_with('\n')) text += '\n';
    std::fputs(text.c_str(), stderr);
}

}  // namespace nplc::host
