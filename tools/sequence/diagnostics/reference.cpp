#include "diagnostics/reference.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnostics/explanation_texts.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMost = 8;
constexpr std::size_t kMeaning = 1'000;  ///< the weight of what the word means

bool is_word_character(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

constexpr std::string_view kWords = "Words";  ///< the section with a row for each

/// Number of occurrences as a word; in code formatting each counts three times.
std::size_t weight(std::string_view text, std::string_view word) {
    std::size_t sum = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if (at > 0 && is_word_character(text[at - 1])) continue;
        if (end < text.size() && is_word_character(text[end])) continue;
        const bool in_code =
            std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '`') % 2;
        const bool begins_row = text.substr(0, at) == "| `";
        sum += begins_row ? 20 : in_code ? 3 : 1;
    }
    return sum;
}

bool ends_block(std::string_view line) {
    return line.empty() || line.starts_with("|") || line.starts_with("#") || line.starts_with("    ");
}

/// Takes the next paragraph, row or rule of the text.
std::string_view take_block(std::string_view& rest) {
    std::size_t length = 0;
    while (length < rest.size()) {
        const std::size_t end = std::min(rest.find('\n', length), rest.size());
        const std::string_view line = rest.substr(length, end - length);
        if (length > 0 && ends_block(line)) break;
        length = std::min(end + 1, rest.size());
        if (ends_block(line)) break;
    }
    std::string_view block = rest.substr(0, length);
    rest.remove_prefix(length);
    while (block.ends_with('\n')) block.remove_suffix(1);
    return block;
}

}  // namespace

std::vector<Paragraph> passages_about(std::string_view word) {
    struct Found {
        Paragraph passage;
        std::size_t weight;
    };
    std::vector<Found> found;
    std::string_view section;
    for (std::string_view rest = language_reference(); !rest.empty();) {
        const std::string_view block = take_block(rest);
        if (block.starts_with("#")) section = block.substr(block.find_first_not_of("# "));
        const bool is_rule = block.starts_with("    ") && section.ends_with("Grammar");
        if (block.starts_with("#") || (block.starts_with("    ") && !is_rule)) continue;
        const bool is_of_words = section.ends_with(kWords);
        const bool means = is_of_words && block.starts_with(fmt::format("| `{}` |", word));
        const std::size_t here = means ? kMeaning : is_of_words ? 0 : weight(block, word);
        if (here != 0) found.push_back(Found{Paragraph{section, block}, is_rule ? std::size_t{1} : here + 1});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.weight > b.weight; });
    std::vector<Paragraph> passages;
    for (const Found& one : found) {
        if (passages.size() < kMost) passages.push_back(one.passage);
    }
    return passages;
}

std::string shown(const Paragraph& passage) {
    constexpr std::string_view kBar = " | ";
    const std::size_t begin = passage.text.find(kBar);
    const std::size_t end = passage.text.rfind(kBar);
    if (!passage.section.ends_with(kWords) || begin == end) return std::string(passage.text);
    const std::string sections(passage.text.substr(end + kBar.size(), passage.text.size() - end - 5));
    return std::string(passage.text.substr(begin + kBar.size(), end - begin - kBar.size())) +
           (sections.find(',') == sections.npos ? " (section " : " (sections ") + sections + ")";
}

std::vector<std::string_view> reference_words() {
    constexpr std::size_t kShortest = 3;
    std::vector<std::string_view> words;
    const std::string_view text = language_reference();
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        bool is_small = false;
        for (; end < text.size() && is_word_character(text[end]); ++end)
            is_small = is_small || (text[end] >= 'a' && text[end] <= 'z');
        const bool begins_with_letter = text[at] >= 'A' && text[at] <= 'Z';
        if (end - at >= kShortest && !is_small && begins_with_letter)
            words.push_back(text.substr(at, end - at));
        at = std::max(end, at + 1);
    }
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

}  // namespace nplc::seqc
