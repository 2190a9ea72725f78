#include "language/notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

/// STEP NEVER: is reported at its declaration only; its uses are read as those of a name.
bool is_declared_step(const std::vector<Token>& tokens, std::string_view word) {
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
        const Token& behind = tokens[i + 2];
        const bool ends_head = behind.text == ":" || same_name(behind.text, "AT");
        if (same_name(tokens[i].text, "STEP") && same_name(tokens[i + 1].text, word) && ends_head)
            return true;
    }
    return false;
}

void refuse_step_name(Report& report, const ast::Name& name) {
    report.add(
        "E011", name.span,
        fmt::format("'{0}' is a word of the language: neither NEXT := {0} nor STEP = {0} in a property could "
                    "tell the step from it",
                    name.text),
        fmt::format("choose another name, such as {}_Step", name.text));
}

bool holds(const std::vector<std::string_view>& names, std::string_view name) {
    return std::ranges::any_of(names, [&](std::string_view known) { return same_name(known, name); });
}

}  // namespace

bool Notes::expect_name(ast::Name& name, std::string_view what, ast::Role role, bool declares) {
    in_.note_place(declares ? ast::Role::other : role);
    if (in_.token().kind != TokenKind::identifier) {
        in_.error_here(what, in_.token().kind == TokenKind::text ? "names stand without quotes" : "");
        return false;
    }
    name = name_of(in_.token());
    const bool is_step = role == ast::Role::step || role == ast::Role::step_or_group;
    if (is_reserved(name.text) && is_step && is_declared_step(in_.tokens(), name.text)) {
        if (declares) refuse_step_name(in_.report(), name);
    } else if (is_reserved(name.text)) {
        in_.report().add("E011", name.span,
                         fmt::format("'{}' is a word of the language, not {}", name.text, what),
                         "choose another name");
        return false;
    }
    add_use(role, name.span, declares);
    in_.skip();
    const bool is_plain =
        std::none_of(name.text.begin(), name.text.end(), [](char c) { return (c & 0x80) != 0; });
    if (!is_plain) faulty_names_.push_back(name.text);  // E001 was reported
    return true;
}

bool Notes::end_block(std::string_view end_word, Span opened) {
    const bool closed = in_.take(end_word);
    const Span last = in_.last().span;
    blocks_.push_back({end_word, {opened.offset, last.offset + last.length - opened.offset}, closed});
    if (closed) {
        in_.take_symbol(";");
        return true;
    }
    if (in_.in_open_comment()) return false;
    const std::string_view block = end_word.substr(std::string_view("END_").size());
    if (in_.end_was_reported()) {
        in_.report().last().notes.push_back({opened, fmt::format("this {} is still open", block)});
        return false;
    }
    Diagnostic& d = in_.report().add("E012", in_.place_here(),
                                     fmt::format("expected {}, found {}", end_word, shown(in_.token())),
                                     fmt::format("write {} where the {} ends", end_word, block));
    d.notes.push_back({opened, fmt::format("this {} is still open", block)});
    return false;
}

bool Notes::is_register(std::string_view name) const {
    return holds(registers_, name);
}

bool Notes::is_sequence(std::string_view name) const {
    return holds(sequences_, name);
}

void Notes::hand_over(ast::Program& program) {
    program.texts = std::move(texts_);
    program.uses = std::move(uses_);
    program.blocks = std::move(blocks_);
    program.names_missing = program.names_missing || names_missing_;
    program.has_calls = has_calls_;
    program.faulty_names = std::move(faulty_names_);
}

}  // namespace nplc::seqc
