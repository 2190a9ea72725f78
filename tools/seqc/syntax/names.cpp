#include "syntax/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace nplc::seqc {
namespace {

constexpr std::size_t kLongestName = 64;

char upper_char(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Levenshtein's distance, with two neighbours swapped as one change. Both have at most kLongestName.
std::size_t distance(std::string_view a, std::string_view b) {
    std::array<std::array<std::uint8_t, kLongestName + 1>, kLongestName + 1> d;
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<std::uint8_t>(i);
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = static_cast<std::uint8_t>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int change = upper_char(a[i - 1]) == upper_char(b[j - 1]) ? 0 : 1;
            d[i][j] = static_cast<std::uint8_t>(
                std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change}));
            if (i > 1 && j > 1 && upper_char(a[i - 1]) == upper_char(b[j - 2]) &&
                upper_char(a[i - 2]) == upper_char(b[j - 1])) {
                d[i][j] = std::min<std::uint8_t>(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

bool same_name(std::string_view a, std::string_view b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](char x, char y) { return upper_char(x) == upper_char(y); });
}

std::string upper(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), upper_char);
    return result;
}

bool is_identifier(std::string_view text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !text.empty() && letter(text[0]) &&
           std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates) {
    if (name.empty() || name.size() > kLongestName) return {};
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (std::string_view candidate : candidates) {
        const std::size_t longer = std::max(candidate.size(), name.size());
        const std::size_t shorter = std::min(candidate.size(), name.size());
        if (candidate.size() > kLongestName || longer - shorter >= best_distance) continue;
        const std::size_t d = distance(name, candidate);
        if (d < best_distance && d < candidate.size()) {
            best = candidate;
            best_distance = d;
        }
    }
    return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates) {
    const std::string_view best = nearest(name, candidates);
    return best.empty() ? std::string() : fmt::format("did you mean '{}'?", best);
}

}  // namespace nplc::seqc
