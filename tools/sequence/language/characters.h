#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

/// Character classes of programs.
namespace nplc::seqc {

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_word(char c) {
    return is_letter(c) || is_digit(c);
}
inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
/// Zero-width characters, as in text copied from web pages.
inline constexpr auto kInvisible =
    std::to_array<std::string_view>({"\u200b", "\u200c", "\u200d", "\u2060", "\ufeff", "\u00ad"});

inline bool is_symbol(char c) {
    return std::string_view(":;,().=+-*/<>").find(c) != std::string_view::npos;
}

/// A word with foreign letters in plain ASCII.
inline std::string spelt_plainly(std::string_view word) {
    constexpr std::pair<std::string_view, std::string_view> kPlain[] = {
        {"\u00e4", "ae"}, {"\u00f6", "oe"}, {"\u00fc", "ue"}, {"\u00c4", "Ae"}, {"\u00d6", "Oe"},
        {"\u00dc", "Ue"}, {"\u00df", "ss"}, {"\u00e9", "e"},  {"\u00e8", "e"},  {"\u00e0", "a"},
        {"\u00e5", "aa"}, {"\u00f8", "oe"}, {"\u00e6", "ae"}, {"\u00e7", "c"},  {"\u00f1", "n"},
    };
    /// The accent as a character of its own behind the letter, as some systems write names of files.
    constexpr std::string_view kDiaeresis = "\u0308";
    const auto is_accent = [](std::string_view rest) {
        const auto first = static_cast<unsigned char>(rest[0]);
        const auto second = static_cast<unsigned char>(rest.size() > 1 ? rest[1] : '\0');
        return first == 0xCC || (first == 0xCD && second < 0xB0);
    };
    constexpr std::size_t kLongestShown = 120;
    std::string plain;
    while (!word.empty() && plain.size() <= kLongestShown) {
        if (!plain.empty() && is_accent(word)) {
            if (word.starts_with(kDiaeresis) && std::string_view("aouAOU").find(plain.back()) != plain.npos)
                plain += 'e';
            word.remove_prefix(2);
            continue;
        }
        const auto* const known = std::find_if(std::begin(kPlain), std::end(kPlain), [&](const auto& pair) {
            return word.starts_with(pair.first);
        });
        if (known == std::end(kPlain) && !is_word(word.front())) break;
        plain += known == std::end(kPlain) ? word.substr(0, 1) : known->second;
        word.remove_prefix(known == std::end(kPlain) ? 1 : known->first.size());
    }
    return word.empty() ? fmt::format("write {}, or letters a to z, digits and _", plain)
                        : "names are letters a to z, digits and _";
}

}  // namespace nplc::seqc
