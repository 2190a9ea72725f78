#include "lsp/scenario_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "language/names.h"
#include "lsp/scenario_words.h"
#include "rehearsal/scenario_text.h"

namespace nplc::seqc::lsp {
namespace {

constexpr int kEvent = 24;  // SymbolKind

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != line.npos && (line[first] == '#' || line.substr(first, 2) == "//");
}

/// A line without its comment and without blanks at both ends.
Span sentence_in(const analysis::Lines& lines, std::uint32_t number) {
    const std::string_view line = lines.line(number);
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    std::size_t end = first;
    bool quoted = false;
    for (std::size_t at = first; at < line.size(); ++at) {
        if (line[at] == '"') quoted = !quoted;
        if (!quoted && (line[at] == '#' || line.substr(at, 2) == "//")) break;
        if (line[at] != ' ' && line[at] != '\t' && line[at] != '\r') end = at + 1;
    }
    return {lines.start_of(number) + static_cast<std::uint32_t>(first),
            static_cast<std::uint32_t>(end - first)};
}

std::vector<std::string_view> candidates_for(const Word& word, const analysis::Program& program) {
    using analysis::Kind;
    std::vector<std::string_view> names;
    for (const analysis::Definition& definition : program.definitions()) {
        const bool signal = definition.kind == Kind::input || definition.kind == Kind::output;
        const bool point = definition.kind == Kind::set_point && word.has_value;
        if (word.is_step ? definition.kind == Kind::step : signal || point) names.push_back(definition.name);
    }
    if (!word.is_step) {
        for (const std::string_view sentence : sentence_words()) names.push_back(sentence);
    }
    return names;
}

bool is_known(const Word& word, const std::vector<std::string_view>& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return same_name(name, word.text); });
}

}  // namespace

Json scenario_symbols(const Workspace& workspace, const At& at) {
    Json list = Json::array();
    const analysis::Lines& lines = at.document.lines();
    for (std::uint32_t number = 0; number < lines.count(); ++number) {
        const Span sentence = sentence_in(lines, number);
        if (sentence.length == 0) continue;
        const Json range = workspace.range_json(lines, sentence);
        list.push_back({{"name", at.document.text().substr(sentence.offset, sentence.length)},
                        {"kind", kEvent},
                        {"range", range},
                        {"selectionRange", range}});
    }
    return list;
}

Json text_folds(const analysis::Lines& lines) {
    Json list = Json::array();
    const auto count = static_cast<std::uint32_t>(lines.count());
    for (std::uint32_t first = 0; first < count; ++first) {
        std::uint32_t after = first;
        while (after < count && is_comment(lines.line(after))) ++after;
        if (after > first + 1)
            list.push_back({{"startLine", first}, {"endLine", after - 1}, {"kind", "comment"}});
        first = std::max(first, after);
    }
    return list;
}

std::vector<Span> scenario_selections(const At& at, std::uint32_t offset) {
    std::vector<Span> spans;
    const auto add = [&](Span span) {
        const bool is_new = spans.empty() || !(spans.back() == span);
        if (span.length > 0 && analysis::holds(span, offset) && is_new) spans.push_back(span);
    };
    for (const Word& word : words_of(at.document.text())) add(word.span);
    if (spans.size() > 1) spans.resize(1);  // between two words: the first
    add(sentence_in(at.document.lines(), at.document.lines().line_of(offset)));
    add({0, static_cast<std::uint32_t>(at.document.text().size())});
    return spans;
}

Json scenario_fixes(const Workspace& workspace, const At& at, const Json& params) {
    Json actions = Json::array();
    if (!at.view.program) return actions;
    const analysis::Lines& lines = at.document.lines();
    const Span range = workspace.span_in(at.document, params.value("range", Json()));
    const std::uint32_t first = lines.line_of(range.offset);
    const std::uint32_t last = lines.line_of(analysis::end_of(range));
    std::vector<std::uint32_t> wrong;  // lines of mistakes, from 0
    for (const auto& mistake : rehearsal::mistakes_in_scenario(
             at.document.text(), path_of_uri(at.document.uri()), at.view.program->compiled().symbols)) {
        if (mistake.line > 0) wrong.push_back(static_cast<std::uint32_t>(mistake.line - 1));
    }
    for (const Word& word : words_of(at.document.text())) {
        const std::uint32_t line = lines.line_of(word.span.offset);
        const bool faulty = std::find(wrong.begin(), wrong.end(), line) != wrong.end();
        if (line < first || line > last || !faulty || word.is_of_order) continue;
        const std::vector<std::string_view> names = candidates_for(word, *at.view.program);
        const std::string_view meant = is_known(word, names) ? "" : nearest(word.text, names);
        if (meant.empty()) continue;
        actions.push_back(
            {{"title", fmt::format("Write '{}'", meant)},
             {"kind", "quickfix"},
             {"edit",
              {{"changes",
                {{at.document.uri(),
                  {{{"range", workspace.range_json(lines, word.span)}, {"newText", meant}}}}}}}}});
    }
    return actions;
}

}  // namespace nplc::seqc::lsp
