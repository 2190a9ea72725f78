#include "language/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "text/edit_distance.h"

namespace nplc::seqc {
namespace {

char upper_char(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
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
    return spelling::nearest(name, candidates);
}

std::vector<std::string_view> all_nearest(std::string_view name,
                                          const std::vector<std::string_view>& candidates) {
    const std::string_view best = nearest(name, candidates);
    std::vector<std::string_view> all;
    if (best.empty()) return all;
    const std::size_t distance = spelling::edit_distance(name, best);
    for (const std::string_view word : candidates) {
        if (spelling::edit_distance(name, word) == distance) all.push_back(word);
    }
    return all;
}

std::vector<std::string_view> most_similar(std::string_view name,
                                           const std::vector<std::string_view>& candidates,
                                           std::size_t most) {
    std::vector<std::pair<std::size_t, std::string_view>> near;
    for (const std::string_view word : candidates) {
        const std::size_t distance = spelling::edit_distance(name, word);
        if (2 * distance <= std::max(name.size(), word.size())) near.emplace_back(distance, word);
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    if (near.size() > most) near.resize(most);
    std::vector<std::string_view> result;
    for (const auto& [distance, word] : near) result.push_back(word);
    return result;
}

std::string_view numbered_timer(std::string_view name) {
    for (const std::string_view word : {"TIMER", "COUNTER"}) {
        if (name.size() <= word.size() || !same_name(name.substr(0, word.size()), word)) continue;
        std::string_view digits = name.substr(word.size());
        if (digits.size() > 1 && digits.front() == '_') digits.remove_prefix(1);
        if (digits.find_first_not_of("0123456789") == digits.npos) return word;
    }
    return {};
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates) {
    const std::string_view best = nearest(name, candidates);
    return best.empty() ? std::string() : fmt::format("did you mean '{}'?", best);
}

}  // namespace nplc::seqc
