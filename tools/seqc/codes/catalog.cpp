#include "codes/catalog.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

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

}  // namespace

std::vector<CodeInfo> catalog() {
    using namespace codes;
    std::vector<CodeInfo> all;
    for (const auto& family : {kText, kGrammar, kNames, kMotor, kCommands, kScan, kTerms, kProgram, kRaw,
                               kWarnings, kMoreWarnings}) {
        all.insert(all.end(), family.begin(), family.end());
    }
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
