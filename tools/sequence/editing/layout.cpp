#include "editing/layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/lexer.h"
#include "language/names.h"
#include "seqc/format.h"

namespace nplc::seqc::analysis {
namespace {

std::vector<Span> words_of(const std::vector<Token>& tokens, const std::vector<Token>& comments) {
    std::vector<Span> words;
    for (const Token& token : tokens) {
        if (token.kind != TokenKind::end) words.push_back(token.span);
    }
    for (const Token& comment : comments) words.push_back(comment.span);
    std::sort(words.begin(), words.end(), [](Span a, Span b) { return a.offset < b.offset; });
    return words;
}

std::string problem_of(const Formatted& formatted, const Program& program) {
    if (!formatted.fault.empty()) return formatted.fault;
    if (formatted.diagnostics.empty()) return "the program cannot be laid out";
    const Diagnostic& first = formatted.diagnostics.front();
    return fmt::format("line {}: {}", program.lines().line_of(first.span.offset) + 1, first.message);
}

/// Both texts have the same words: returns the differing text between words.
std::vector<TextEdit> differences(std::string_view before, const std::vector<Span>& old_words,
                                  std::string_view after, const std::vector<Span>& new_words) {
    std::vector<TextEdit> edits;
    std::uint32_t old_at = 0;
    std::uint32_t new_at = 0;
    const auto gap = [&](std::uint32_t old_end, std::uint32_t new_end) {
        const std::string_view was = before.substr(old_at, old_end - old_at);
        const std::string_view becomes = after.substr(new_at, new_end - new_at);
        if (was != becomes) edits.push_back({{old_at, old_end - old_at}, std::string(becomes)});
    };
    for (std::size_t i = 0; i < old_words.size(); ++i) {
        gap(old_words[i].offset, new_words[i].offset);
        const std::string_view was = before.substr(old_words[i].offset, old_words[i].length);
        const std::string_view becomes = after.substr(new_words[i].offset, new_words[i].length);
        if (was != becomes) edits.push_back({old_words[i], std::string(becomes)});
        old_at = end_of(old_words[i]);
        new_at = end_of(new_words[i]);
    }
    gap(static_cast<std::uint32_t>(before.size()), static_cast<std::uint32_t>(after.size()));
    return edits;
}

bool begins_with_end(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == line.npos) return false;
    const std::string word = upper(line.substr(first, line.find_first_of(" \t;:(", first) - first));
    return word.starts_with("END_") || word == "ELSE" || word == "ELSIF";
}

}  // namespace

Layout format_whole(const Program& program) {
    return format_range(program, {0, program.size()});
}

Layout format_range(const Program& program, Span range) {
    const Formatted formatted = format_program(program.source());
    if (!formatted.ok) return {{}, problem_of(formatted, program)};
    Report noise;
    std::vector<Token> comments;
    const std::vector<Token> tokens = tokens_of(formatted.text, noise, &comments);
    const std::vector<Span> old_words = words_of(program.tokens(), program.comments());
    const std::vector<Span> new_words = words_of(tokens, comments);
    if (old_words.size() != new_words.size()) return {{{{0, program.size()}, formatted.text}}, {}};
    Layout layout{differences(program.source(), old_words, formatted.text, new_words), {}};
    const std::uint32_t first = program.lines().start_of(program.lines().line_of(range.offset));
    std::erase_if(layout.edits, [&](const TextEdit& edit) {
        return end_of(edit.span) < first || edit.span.offset > end_of(range);
    });
    return layout;
}

Layout format_typed(const Program& program, std::uint32_t offset, bool begins_line) {
    const std::uint32_t number = program.lines().line_of(offset);
    const std::uint32_t start = program.lines().start_of(number);
    const std::string_view line = program.lines().line(number);
    if (program.in_comment(start) || (!begins_line && !begins_with_end(line))) return {};
    const std::size_t text = std::min(line.find_first_not_of(" \t"), line.size());
    const auto begin = static_cast<std::uint32_t>(start + text);
    std::size_t depth = 0;
    for (const ast::Block& block : program.tree().blocks) {
        if (block.end_word == "END_PROGRAM" || block.span.offset >= start) continue;
        const bool open_here = block.closed
                                   ? end_of(block.span) > begin
                                   : end_of(block.span) >= begin ||
                                         program.text({end_of(block.span), begin - end_of(block.span)})
                                                 .find_first_not_of(" \t\r\n") == std::string_view::npos;
        if (open_here) ++depth;
    }
    if (begins_with_end(line) && depth > 0) --depth;
    const std::string wanted(depth * 4, ' ');
    if (line.substr(0, text) == wanted) return {};
    return {{{{start, static_cast<std::uint32_t>(text)}, wanted}}, {}};
}

}  // namespace nplc::seqc::analysis
