#include "macreg/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace nplc::macreg {

namespace {

constexpr int kDotsAcross = 2;
constexpr int kDotsDown = 4;
// Of Unicode's braille patterns, by column and row.
constexpr std::array<std::array<std::uint8_t, kDotsDown>, kDotsAcross> kDots{
    {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}}};

/// U+2800 and a byte of dots in UTF-8.
std::string braille_letter(std::uint8_t dots) {
    return {static_cast<char>(0xE2), static_cast<char>(0xA0 | dots >> 6),
            static_cast<char>(0x80 | (dots & 0x3F))};
}

}  // namespace

std::vector<std::string> text_curve(std::span<const double> values, int width, int height, double low,
                                    double high, bool braille) {
    std::vector<std::string> rows;
    if (width < 1 || height < 1) return rows;
    const int across = braille ? width * kDotsAcross : width;
    const int down = braille ? height * kDotsDown : height;
    std::vector<std::uint8_t> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    const auto set = [&](int x, int y) {
        const int cell_x = braille ? x / kDotsAcross : x;
        const int cell_y = braille ? y / kDotsDown : y;
        auto& cell = cells[index(cell_x, cell_y)];
        cell = static_cast<std::uint8_t>(
            cell |
            (braille
                 ? kDots[static_cast<std::size_t>(x % kDotsAcross)][static_cast<std::size_t>(y % kDotsDown)]
                 : 1));
    };
    const double span = high > low ? high - low : 1;
    const auto dot_of = [&](double value) {
        return std::clamp(static_cast<int>(std::lround((high - value) / span * (down - 1))), 0, down - 1);
    };
    int before = -1;
    const auto size = static_cast<double>(values.size());
    for (int x = 0; x < across && !values.empty(); ++x) {
        const auto first = static_cast<std::size_t>(size * x / across);
        const auto end = std::max(first + 1, static_cast<std::size_t>(size * (x + 1) / across));
        for (std::size_t i = first; i < std::min(end, values.size()); ++i) {
            const int y = dot_of(values[i]);
            // The gap between two neighbours is filled, so that a step is a line
            for (int between = std::min(before < 0 ? y : before, y); between <= std::max(before, y);
                 ++between)
                set(x, between);
            before = y;
        }
    }
    for (int y = 0; y < height; ++y) {
        std::string row;
        for (int x = 0; x < width; ++x) {
            const std::uint8_t cell = cells[index(x, y)];
            row += braille ? (cell != 0 ? braille_letter(cell) : " ") : (cell != 0 ? "*" : " ");
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

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
