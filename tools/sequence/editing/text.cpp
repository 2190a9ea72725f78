#include "editing/text.h"

#include <algorithm>

namespace nplc::seqc::analysis {
namespace {

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Bytes of the character at `at`; 1 for invalid UTF-8.
std::size_t length_at(std::string_view text, std::size_t at) {
    const auto lead = static_cast<unsigned char>(text[at]);
    const std::size_t length = lead < 0xC2 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 1;
    for (std::size_t i = 1; i < length; ++i) {
        if (at + i >= text.size() || !continues(text[at + i])) return 1;
    }
    return length;
}

std::uint32_t units_of(std::size_t bytes, Encoding encoding) {
    if (encoding == Encoding::utf8) return static_cast<std::uint32_t>(bytes);
    return bytes == 4 ? 2 : 1;
}

}  // namespace

std::uint32_t characters_in(std::string_view text, Encoding encoding) {
    std::uint32_t count = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = length_at(text, at);
        count += units_of(bytes, encoding);
        at += bytes;
    }
    return count;
}

Lines::Lines(std::string_view text) : text_(text), starts_{0} {
    for (std::uint32_t at = 0; at < text.size(); ++at) {
        const bool lone_return = text[at] == '\r' && (at + 1 >= text.size() || text[at + 1] != '\n');
        if (text[at] == '\n' || lone_return) starts_.push_back(at + 1);
    }
}

std::uint32_t Lines::line_of(std::uint32_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    return static_cast<std::uint32_t>(after - starts_.begin() - 1);
}

std::string_view Lines::line(std::uint32_t number) const {
    const std::size_t start = starts_[number];
    const std::size_t end = number + 1 < starts_.size() ? starts_[number + 1] : text_.size();
    std::string_view line = text_.substr(start, end - start);
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    return line;
}

Place Lines::place_of(std::uint32_t offset, Encoding encoding) const {
    const auto at = static_cast<std::uint32_t>(std::min<std::size_t>(offset, text_.size()));
    const std::uint32_t number = line_of(at);
    const std::string_view before = line(number).substr(0, at - starts_[number]);
    return {number, characters_in(before, encoding)};
}

Range Lines::range_of(Span span, Encoding encoding) const {
    return {place_of(span.offset, encoding), place_of(span.offset + span.length, encoding)};
}

std::uint32_t Lines::offset_of(Place place, Encoding encoding) const {
    if (place.line >= starts_.size()) return static_cast<std::uint32_t>(text_.size());
    const std::string_view whole = line(place.line);
    std::size_t at = 0;
    for (std::uint32_t counted = 0; at < whole.size();) {
        const std::size_t bytes = length_at(whole, at);
        counted += units_of(bytes, encoding);
        if (counted > place.character) break;
        at += bytes;
    }
    return starts_[place.line] + static_cast<std::uint32_t>(at);
}

}  // namespace nplc::seqc::analysis
