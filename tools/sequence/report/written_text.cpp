#include "report/written_text.h"

#include <algorithm>
#include <vector>

#include "diagnostics/report.h"
#include "language/lexer.h"
#include "language/names.h"
#include "report/table_text.h"

namespace nplc::seqc {
namespace {

std::string in_capitals_if_joining(std::string_view word) {
    for (const std::string_view joining : {"AND", "OR", "XOR", "NOT", "ELSE"}) {
        if (same_name(word, joining)) return std::string(joining);
    }
    return std::string(word);
}

}  // namespace

std::string_view WrittenText::word(std::string_view text) const {
    if (arguments_ == nullptr) return text;
    for (const Written::Argument& argument : *arguments_) {
        if (same_name(argument.parameter, text)) return argument.text;
    }
    return text;
}

std::string WrittenText::of(Span span) const {
    if (span.offset > source_.size()) return {};
    const std::string_view slice = source_.substr(span.offset, span.length);
    Report ignored;
    std::string text;
    std::uint32_t end = 0;
    for (const Token& token : tokens_of(slice, ignored)) {
        if (token.kind == TokenKind::end) break;
        if (token.span.offset > end && !text.empty()) text += ' ';
        text += in_capitals_if_joining(word(token.text));
        end = token.span.offset + token.span.length;
    }
    return text;
}

std::string WrittenText::condition(const Written::Branch& branch) const {
    const std::string text = of(branch.condition);
    if (text == "ELSE") return "ELSE";
    const bool is_statement =
        std::any_of(branch.statements.begin(), branch.statements.end(), [&](Span statement) {
            return statement.offset >= branch.condition.offset &&
                   statement.offset < branch.condition.offset + branch.condition.length;
        });
    const std::string_view first = std::string_view(text).substr(0, text.find_first_of(" :"));
    const bool is_next = same_name(first, "NEXT") || same_name(first, "CALL");
    return text.empty() || is_statement || is_next ? "always" : text + limit_behind(branch.condition);
}

/// " WITHIN T#3s"
std::string WrittenText::limit_behind(Span condition) const {
    constexpr std::size_t kLongest = 200;
    const std::uint32_t end = condition.offset + condition.length;
    if (end > source_.size()) return {};
    Report ignored;
    const std::vector<Token> tokens = tokens_of(source_.substr(end, kLongest), ignored);
    if (!same_name(tokens.front().text, "WITHIN")) return {};
    const auto then = std::find_if(tokens.begin(), tokens.end(), [](const Token& token) {
        return token.kind == TokenKind::end || same_name(token.text, "THEN");
    });
    return " " + of({end, then->span.offset});
}

std::string WrittenText::statements(const std::vector<Span>& spans) const {
    constexpr std::string_view kMark = "EVERY_SCAN ";
    std::string text;
    for (const Span span : spans) {
        const std::string statement = of(span);
        const bool marked = same_name(std::string_view(statement).substr(0, kMark.size()), kMark);
        append(text, marked ? statement.substr(kMark.size()) : statement, "; ");
    }
    return text;
}

std::string WrittenText::value(Span declaration) const {
    const std::string text = of(declaration);
    const std::size_t name = text.find(' ');
    const std::size_t value = text.find(":=");
    if (name == std::string::npos || value == std::string::npos) return text;
    return text.substr(0, name + 1) + text.substr(value);
}

}  // namespace nplc::seqc
