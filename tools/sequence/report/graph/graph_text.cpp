#include "report/graph/graph_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace nplc::seqc {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Bytes of the character at the start of `text`; 0 if it is not valid in XML.
std::size_t character_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), continues))
        return 0;
    std::uint32_t code = first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i)
        code = (code << 6) | (static_cast<unsigned char>(text[i]) & 0x3FU);
    constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool control = code < 0xA0 || code == 0xFFFE || code == 0xFFFF;
    return code < kLeast[length] || code > 0x10FFFF || surrogate || control ? 0 : length;
}

/// Calls `use` with each character, with a replacement for invalid ones.
template <class Use>
void for_each_character(std::string_view text, Use use) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        use(length == 0 ? kReplacement : text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
}

std::string_view entity(std::string_view character) {
    if (character == "&") return "&amp;";
    if (character == "<") return "&lt;";
    if (character == ">") return "&gt;";
    if (character == "\"") return "&quot;";
    return character;
}

std::size_t characters_in(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

/// Length of the unbreakable part at the start of `text`, with its trailing blank.
std::size_t piece_length(std::string_view text) {
    for (std::size_t at = 1; at < text.size(); ++at) {
        if (text[at - 1] != ' ') continue;
        const bool after_mark = at >= 2 && (text[at - 2] == ',' || text[at - 2] == ';');
        if (after_mark || text.substr(at).starts_with("AND ") || text.substr(at).starts_with("OR "))
            return at;
    }
    return text.size();
}

}  // namespace

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for_each_character(text, [&](std::string_view character) {
        if (character == "\"" || character == "\\") result += '\\';
        result += character;
    });
    return result + "\"";
}

std::string markup(std::string_view text) {
    std::string result;
    for_each_character(text, [&](std::string_view character) { result += entity(character); });
    return result;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    const bool fits = characters_in(text) <= width;
    while (!text.empty()) {
        const std::string_view piece = text.substr(0, piece_length(text));
        text.remove_prefix(piece.size());
        if (lines.empty() || (!fits && piece.starts_with("OR ")) ||
            characters_in(lines.back()) + characters_in(piece) > width)
            lines.emplace_back();
        lines.back() += piece;
    }
    for (std::string& line : lines) {
        while (line.ends_with(' ')) line.pop_back();
    }
    return lines;
}

}  // namespace nplc::seqc
