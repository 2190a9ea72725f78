#include "diagnostics/explanations.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "diagnostics/explanation_texts.h"

namespace nplc::seqc {
namespace {

struct Repetition {
    int first = 1;
    int last = 1;
    std::string_view line;
};

std::optional<Repetition> repetition_in(std::string_view line) {
    const std::size_t dots = line.find("..");
    const std::size_t end = line.find('}');
    if (!line.starts_with('{') || dots == std::string_view::npos || end == std::string_view::npos)
        return std::nullopt;
    Repetition result;
    std::from_chars(line.data() + 1, line.data() + dots, result.first);
    std::from_chars(line.data() + dots + 2, line.data() + end, result.last);
    result.line = line.substr(end + 1);
    return result;
}

std::string numbered(std::string_view line, int number) {
    std::string text;
    for (char c : line) {
        if (c == '$') {
            text += std::to_string(number);
        } else if (c == '@') {
            text += std::to_string(number + 1);
        } else {
            text += c;
        }
    }
    return text + "\n";
}

template <typename Repeat>
std::string written_out(std::string_view example, Repeat repeat) {
    std::string text;
    while (!example.empty()) {
        const std::size_t end = std::min(example.find('\n'), example.size() - 1);
        const std::string_view line = example.substr(0, end + 1);
        const auto repetition = repetition_in(line);
        if (repetition) {
            text += repeat(Repetition{repetition->first, repetition->last,
                                      repetition->line.substr(0, repetition->line.size() - 1)});
        } else {
            text += line;
        }
        example.remove_prefix(line.size());
    }
    return text;
}

constexpr std::string_view kEntry = "\n=== ";
constexpr std::string_view kExample = "\n--- wrong (-) and right (+)\n";

/// Parses "=== E012 title", the explanation, and an optional example: lines of both programs begin with a
/// blank, those of the wrong one with -, of the right one with +.
Explanation entry(std::string_view text) {
    const std::size_t title_end = text.find('\n');
    const std::size_t example = std::min(text.find(kExample), text.size() - 1);
    Explanation result{text.substr(4, 4),
                       text.substr(9, title_end - 9),
                       text.substr(title_end + 1, example - title_end - 1),
                       {},
                       {}};
    text.remove_prefix(std::min(example + kExample.size(), text.size()));
    while (!text.empty()) {
        const std::string_view line = text.substr(1, text.find('\n'));
        if (text[0] != '+') result.wrong += line;
        if (text[0] != '-') result.right += line;
        text.remove_prefix(line.size() + 1);
    }
    return result;
}

}  // namespace

std::vector<Explanation> explanations() {
    std::vector<Explanation> all;
    for (std::string_view text : kExplanationTexts) {
        while (!text.empty()) {
            const std::size_t length = std::min(text.find(kEntry, 1), text.size() - 1) + 1;
            all.push_back(entry(text.substr(0, length)));
            text.remove_prefix(length);
        }
    }
    std::sort(all.begin(), all.end(),
              [](const Explanation& a, const Explanation& b) { return a.code < b.code; });
    return all;
}

std::string whole_program(std::string_view example) {
    return written_out(example, [](const Repetition& r) {
        std::string text;
        for (int i = r.first; i <= r.last; ++i) text += numbered(r.line, i);
        return text;
    });
}

std::string shown_program(std::string_view example) {
    return written_out(example, [](const Repetition& r) {
        return numbered(r.line, r.first) +
               fmt::format("// ... {} such lines in all ...\n", r.last - r.first + 1) +
               numbered(r.line, r.last);
    });
}

}  // namespace nplc::seqc
