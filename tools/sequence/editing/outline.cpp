#include "editing/outline.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "language/reserved_words.h"

namespace nplc::seqc::analysis {
namespace {

std::string detail_of(const Program& program, const Definition& definition) {
    if (definition.kind == Kind::step) {
        const auto number = program.number_of_step(definition.name);
        return number && *number < 62 ? fmt::format("step {}", *number) : "";
    }
    return std::string(definition.address);
}

Symbol symbol_of(const Program& program, const Definition& definition) {
    std::string name(definition.name);
    if (name.empty()) name = "?";
    return {definition.kind,  std::move(name),      detail_of(program, definition),
            definition.whole, definition.name_span, {}};
}

TokenType type_of_role(const Program& program, const Reference& reference) {
    using ast::Role;
    const Definition* definition = program.definition_of(reference);
    switch (reference.role) {
        case Role::step:
            return TokenType::step;
        case Role::step_or_group:
            return definition != nullptr && definition->kind == Kind::group ? TokenType::group
                                                                            : TokenType::step;
        case Role::group:
            return TokenType::group;
        case Role::output:
            return TokenType::output;
        case Role::tested:
            return definition != nullptr && definition->kind == Kind::output ? TokenType::output
                                                                             : TokenType::input;
        case Role::input:
            return TokenType::input;
        case Role::address:
            return upper(program.text(reference.span)).find('O') == 0 ||
                           upper(program.text(reference.span)).starts_with("%Q")
                       ? TokenType::output
                       : TokenType::input;
        case Role::command:
            return TokenType::command;
        case Role::motor_variable:
        case Role::register_name:
            return TokenType::register_name;
        case Role::constant:
            return TokenType::number;
        case Role::unit:
            return TokenType::unit;
        case Role::motor:
        case Role::program:
            return TokenType::motor;
        default:
            return TokenType::property;
    }
}

bool is_word_operator(std::string_view text) {
    return same_name(text, "AND") || same_name(text, "OR") || same_name(text, "XOR") ||
           same_name(text, "NOT");
}

}  // namespace

std::vector<Symbol> symbols_of(const Program& program) {
    std::vector<Symbol> top;
    const Definition* whole = nullptr;
    std::vector<Symbol> children;
    for (const Definition& definition : program.definitions()) {
        if (definition.kind == Kind::program) {
            whole = &definition;
        } else {
            children.push_back(symbol_of(program, definition));
        }
    }
    if (program.tree().power_up) {
        const Span name = program.tree().power_up->name.span;
        Span block = name;
        for (const ast::Block& b : program.tree().blocks) {
            if (b.end_word == "END_POWER_UP" && b.span.offset == name.offset) block = b.span;
        }
        children.push_back({Kind::step, "POWER_UP", "step 0", block, name, {}});
    }
    std::erase_if(children, [&](const Symbol& child) { return !program.is_own(child.selection); });
    std::sort(children.begin(), children.end(),
              [](const Symbol& a, const Symbol& b) { return a.selection.offset < b.selection.offset; });
    if (whole == nullptr || !program.is_own(whole->name_span)) return children;
    Symbol root = symbol_of(program, *whole);
    for (const Symbol& child : children) {
        const std::uint32_t end = std::max(end_of(root.whole), end_of(child.whole));
        root.whole.offset = std::min(root.whole.offset, child.whole.offset);
        root.whole.length = end - root.whole.offset;
    }
    root.children = std::move(children);
    top.push_back(std::move(root));
    return top;
}

std::vector<Fold> folds_of(const Program& program) {
    std::vector<Fold> folds;
    const auto add = [&](Span span, bool is_comment) {
        if (!program.is_own(span)) return;
        const std::uint32_t first = program.lines().line_of(span.offset);
        const std::uint32_t last = program.lines().line_of(end_of(span));
        if (last > first) folds.push_back({first, last, is_comment});
    };
    for (const ast::Block& block : program.tree().blocks) add(block.span, false);
    const auto& comments = program.comments();
    for (std::size_t i = 0; i < comments.size(); ++i) {
        std::size_t last = i;
        while (last + 1 < comments.size() && comments[last + 1].text.starts_with("//") &&
               program.lines().line_of(comments[last + 1].span.offset) ==
                   program.lines().line_of(end_of(comments[last].span)) + 1)
            ++last;
        add({comments[i].span.offset, end_of(comments[last].span) - comments[i].span.offset}, true);
        i = last;
    }
    std::sort(folds.begin(), folds.end(), [](const Fold& a, const Fold& b) {
        return a.first_line != b.first_line ? a.first_line < b.first_line : a.last_line > b.last_line;
    });
    const auto same = std::unique(folds.begin(), folds.end(),
                                  [](const Fold& a, const Fold& b) { return a.first_line == b.first_line; });
    folds.erase(same, folds.end());
    return folds;
}

std::vector<Span> selections_at(const Program& program, std::uint32_t offset) {
    std::vector<Span> spans;
    const auto add = [&](Span span) {
        if (span.length > 0 && holds(span, offset)) spans.push_back(span);
    };
    if (const Token* token = program.token_at(offset)) add(token->span);
    const auto& tokens = program.tokens();
    for (std::size_t i = 0; i < tokens.size();
         ++i) {  // start of a statement: after a semicolon or a block's word
        const bool begins = i == 0 || tokens[i - 1].text == ";" || tokens[i - 1].text == ":" ||
                            same_name(tokens[i - 1].text, "THEN");
        if (!begins) continue;
        std::size_t last = i;
        while (last < tokens.size() && tokens[last].text != ";" && !same_name(tokens[last].text, "THEN") &&
               tokens[last].kind != TokenKind::end)
            ++last;
        if (last < tokens.size())
            add({tokens[i].span.offset, end_of(tokens[last].span) - tokens[i].span.offset});
    }
    for (const ast::Block& block : program.tree().blocks) add(block.span);
    for (const Definition& definition : program.definitions()) add(definition.whole);
    add({0, program.size()});
    std::sort(spans.begin(), spans.end(), [](Span a, Span b) { return a.length < b.length; });
    std::vector<Span> nested;
    for (const Span& span : spans) {
        const bool contains =
            nested.empty() || (span.offset <= nested.back().offset && end_of(span) >= end_of(nested.back()) &&
                               !(span == nested.back()));
        if (contains) nested.push_back(span);
    }
    return nested;
}

std::vector<Coloured> colours_of(const Program& program) {
    std::vector<Coloured> colours;
    auto reference = program.references().begin();
    const auto end = program.references().end();
    for (const Token& token : program.tokens()) {
        while (reference != end && end_of(reference->span) <= token.span.offset) ++reference;
        const bool named =
            reference != end && reference->span.offset <= token.span.offset && reference->span.length > 0;
        if (named && reference->role == ast::Role::keyword) {
            colours.push_back({token.span, TokenType::keyword});
        } else if (named) {
            const bool fixed =
                reference->role == ast::Role::register_name && reference->definition == Reference::kNone;
            colours.push_back({token.span, type_of_role(program, *reference), reference->declares, fixed});
        } else if (token.kind == TokenKind::number || token.kind == TokenKind::based ||
                   token.kind == TokenKind::time) {
            colours.push_back({token.span, TokenType::number});
        } else if (token.kind == TokenKind::text) {
            colours.push_back({token.span, TokenType::text});
        } else if (token.kind == TokenKind::identifier && is_word_operator(token.text)) {
            colours.push_back({token.span, TokenType::word_operator});
        } else if (token.kind == TokenKind::identifier && is_reserved(token.text)) {
            colours.push_back({token.span, TokenType::keyword});
        }
    }
    for (const Token& comment : program.comments()) colours.push_back({comment.span, TokenType::comment});
    std::sort(colours.begin(), colours.end(),
              [](const Coloured& a, const Coloured& b) { return a.span.offset < b.span.offset; });
    return colours;
}

}  // namespace nplc::seqc::analysis
