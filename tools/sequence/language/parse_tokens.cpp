#include "language/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr auto kReserved = std::to_array<std::string_view>(
    {"PROGRAM",      "END_PROGRAM",   "MOTOR",     "SCALE",     "VAR_INPUT", "VAR_OUTPUT",
     "VAR_MOTOR",    "END_VAR",       "AT",        "ON",        "ERROR",     "NEXT",
     "POWER_UP",     "END_POWER_UP",  "STEP",      "END_STEP",  "OUT",       "WHEN",
     "ENTRY",        "OWN",           "IF",        "THEN",      "ELSIF",     "ELSE",
     "END_IF",       "AND",           "OR",        "NOT",       "XOR",       "TRUE",
     "FALSE",        "INPOS",         "ANY",       "TIMER",     "COUNTER",   "EVERY_SCAN",
     "COUNT_DOWN",   "CLEAR_COUNTER", "TERM",      "REG",       "PROPERTY",  "NEVER",
     "ALWAYS",       "POSSIBLE",      "IS",        "REACHABLE", "WHENEVER",  "WITHIN",
     "ALLOW",        "BECAUSE",       "GROUP",     "IN",        "EXCEPT",    "NO_HELPER",
     "FOR",          "BETWEEN",       "STAYS",     "CHANGES",   "ONLY",      "FOLLOWED",
     "WHILE",        "ENDS",          "ASSUME",    "STABLE",    "CONST",     "SEQUENCE",
     "END_SEQUENCE", "INCLUDE",       "SET_POINT", "RANGE",     "TAKES",     "SET_POINTS"});

/// Keywords that begin a construct above the level of a statement: skipping stops before them.
constexpr std::array kBoundaries = {
    std::string_view("END_PROGRAM"), std::string_view("MOTOR"),      std::string_view("SCALE"),
    std::string_view("VAR_INPUT"),   std::string_view("VAR_OUTPUT"), std::string_view("VAR_MOTOR"),
    std::string_view("END_VAR"),     std::string_view("POWER_UP"),   std::string_view("END_POWER_UP"),
    std::string_view("STEP"),        std::string_view("END_STEP"),   std::string_view("IF"),
    std::string_view("ELSIF"),       std::string_view("ELSE"),       std::string_view("END_IF"),
    std::string_view("PROPERTY"),    std::string_view("GROUP"),      std::string_view("ASSUME"),
    std::string_view("CONST"),       std::string_view("SEQUENCE"),   std::string_view("END_SEQUENCE"),
    std::string_view("INCLUDE"),     std::string_view("SET_POINT"),
};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return same_name(w, word); });
}

}  // namespace

std::string shown(const Token& t) {
    if (t.kind == TokenKind::end) return "the end of the file";
    return t.text.size() <= 40 ? fmt::format("'{}'", t.text) : fmt::format("'{}...'", t.text.substr(0, 37));
}

bool is_reserved(std::string_view word) {
    return contains(kReserved, word);
}

std::span<const std::string_view> reserved_words() {
    return kReserved;
}

bool is_name(std::string_view text) {
    constexpr std::size_t kLongest = 60;
    return text.size() <= kLongest && is_identifier(text) && !is_reserved(text);
}

const Token& Parser::token(std::size_t ahead) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool is_one_of(const Token& token, std::initializer_list<std::string_view> words) {
    return token.kind == TokenKind::identifier &&
           std::ranges::any_of(words, [&](std::string_view word) { return same_name(token.text, word); });
}

bool Parser::at(std::string_view word) const {
    if (is_place()) expected_->words.push_back(word);
    return token().kind == TokenKind::identifier && same_name(token().text, word);
}

bool Parser::at_symbol(std::string_view symbol) const {
    return token().kind == TokenKind::symbol && token().text == symbol;
}

bool Parser::take(std::string_view word) {
    if (!at(word)) return false;
    ++at_;
    return true;
}

bool Parser::take_symbol(std::string_view symbol) {
    if (!at_symbol(symbol)) return false;
    ++at_;
    return true;
}

/// The token, or the end of the last one at the end of the file.
Span Parser::place_here() const {
    if (token().kind != TokenKind::end || at_ == 0) return token().span;
    const Token& last = tokens_[at_ - 1];
    return {last.span.offset + last.span.length, 1};
}

void Parser::error_here(std::string_view expected, std::string help) {
    if (in_open_comment() || end_was_reported()) return;
    report_.add("E010", place_here(), fmt::format("expected {}, found {}", expected, shown(token())),
                std::move(help));
}

bool Parser::expect(std::string_view word, std::string_view where) {
    if (take(word)) return true;
    const std::string expected = fmt::format("{} {}", word, where);
    if (mend({word}, expected)) return take(word);
    error_here(expected);
    return false;
}

bool Parser::is_word_at(std::size_t ahead) const {
    return token(ahead).kind == TokenKind::identifier && !is_reserved(token(ahead).text);
}

bool Parser::mend(const std::vector<std::string_view>& words, std::string_view expected) {
    if (!is_word_at(0) || token().text.size() < 2) return false;
    const std::string_view meant = nearest(token().text, words);
    if (meant.empty()) return false;
    error_here(expected, suggestion(token().text, words));
    tokens_[at_].text = meant;
    return true;
}

/// A word is misspelt if no statement can continue like this: "ELIF Guard", "ENDIF END_STEP", "NXT := Idle".
void Parser::mend_statement(std::vector<std::string_view> end_words) {
    if (!is_word_at(0) || foreign_word(token().text) != nullptr) return;
    const Token& after = token(1);
    const bool symbol = after.kind == TokenKind::symbol;
    if (symbol && after.text == ":=") {
        const bool names_register =
            std::any_of(registers_.begin(), registers_.end(),
                        [&](std::string_view name) { return same_name(name, token().text); });
        const bool names_step = is_word_at(2) || same_name(token(2).text, "POWER_UP");
        if (names_register || !names_step || nearest(token().text, {"NEXT"}).empty()) return;
        report_.add("E021", token().span, fmt::format("there is no register '{}'", token().text),
                    "did you mean 'NEXT'?");
        tokens_[at_].text = "NEXT";
    } else if (symbol && after.text == ";") {
        mend(end_words, "a statement");
    } else if (!symbol || after.text != "(") {
        std::vector<std::string_view> words = std::move(end_words);
        words.insert(words.end(), {"IF", "OUT", "ENTRY", "OWN", "EVERY_SCAN", "TERM", "NEXT", "NO_HELPER"});
        mend(words, "a statement");
    }
}

/// '=' instead of ':='; '=:' becomes one token.
bool Parser::at_equals() {
    if (!at_symbol("=")) return false;
    const Span equals = token().span;
    if (is_symbol_at(1, ":") && token(1).span.offset == equals.offset + equals.length) {
        ++at_;
        tokens_[at_].text = "=:";
        tokens_[at_].span = {equals.offset, equals.length + token().span.length};
    }
    return true;
}

bool Parser::expect_symbol(std::string_view symbol, std::string_view where) {
    if (take_symbol(symbol)) return true;
    const bool only_equals = symbol == ":=" && at_equals();
    error_here(fmt::format("'{}' {}", symbol, where), only_equals ? "write := with a colon" : "");
    if (only_equals) ++at_;
    return only_equals;
}

void Parser::note_place(ast::Role role) const {
    if (is_place()) expected_->names.push_back(role);
}

/// STEP NEVER: is reported at its declaration only; its uses are read as those of a name.
bool Parser::is_declared_step(std::string_view word) const {
    for (std::size_t i = 0; i + 2 < tokens_.size(); ++i) {
        const Token& behind = tokens_[i + 2];
        const bool ends_head = behind.text == ":" || same_name(behind.text, "AT");
        if (same_name(tokens_[i].text, "STEP") && same_name(tokens_[i + 1].text, word) && ends_head)
            return true;
    }
    return false;
}

void Parser::refuse_step_name(const ast::Name& name) {
    report_.add(
        "E011", name.span,
        fmt::format("'{0}' is a word of the language: neither NEXT := {0} nor STEP = {0} in a property could "
                    "tell the step from it",
                    name.text),
        fmt::format("choose another name, such as {}_Step", name.text));
}

bool Parser::expect_name(ast::Name& name, std::string_view what, ast::Role role, bool declares) {
    note_place(declares ? ast::Role::other : role);
    if (token().kind != TokenKind::identifier) {
        error_here(what, token().kind == TokenKind::text ? "names stand without quotes" : "");
        return false;
    }
    name = name_of(token());
    const bool is_step = role == ast::Role::step || role == ast::Role::step_or_group;
    if (is_reserved(name.text) && is_step && is_declared_step(name.text)) {
        if (declares) refuse_step_name(name);
    } else if (is_reserved(name.text)) {
        report_.add("E011", name.span, fmt::format("'{}' is a word of the language, not {}", name.text, what),
                    "choose another name");
        return false;
    }
    note_use(role, name.span, declares);
    ++at_;
    const bool is_plain =
        std::none_of(name.text.begin(), name.text.end(), [](char c) { return (c & 0x80) != 0; });
    if (!is_plain) faulty_names_.push_back(name.text);  // E001 was reported
    return true;
}

bool Parser::end_was_reported() {
    if (token().kind != TokenKind::end) return false;
    return std::exchange(end_reported_, true);
}

Span Parser::span_since(const Token& first) const {
    const Token& last = tokens_[at_ == 0 ? 0 : at_ - 1];
    const std::uint32_t end =
        std::max(first.span.offset + first.span.length, last.span.offset + last.span.length);
    return {first.span.offset, end - first.span.offset};
}

/// A missing semicolon is reported at its place, and parsing continues as if it were there.
void Parser::end_statement() {
    if (take_symbol(";") || in_open_comment() || end_was_reported()) return;
    const Token& last = tokens_[at_ == 0 ? 0 : at_ - 1];
    report_.add("E010", {last.span.offset + last.span.length, 1},
                fmt::format("expected ';' before {}", shown(token())),
                "every statement ends with a semicolon");
    if (token().kind == TokenKind::identifier && token().span.offset > 0 && !at("ERROR")) return;
    recover();
}

bool Parser::at_boundary() const {
    return token().kind == TokenKind::end ||
           (token().kind == TokenKind::identifier && contains(kBoundaries, token().text));
}

void Parser::recover() {
    while (!at_boundary()) {
        if (take_symbol(";")) return;
        ++at_;
    }
}

bool Parser::at_block_end(std::string_view end_word) const {
    return token().kind == TokenKind::end || at(end_word) || at("END_PROGRAM");
}

void Parser::end_block(std::string_view end_word, Span opened) {
    const bool closed = take(end_word);
    const Token& last = tokens_[at_ == 0 ? 0 : at_ - 1];
    blocks_.push_back(
        {end_word, {opened.offset, last.span.offset + last.span.length - opened.offset}, closed});
    if (closed) {
        take_symbol(";");
        return;
    }
    if (in_open_comment()) return;
    const std::string_view block = end_word.substr(std::string_view("END_").size());
    if (end_was_reported()) {
        report_.last().notes.push_back({opened, fmt::format("this {} is still open", block)});
        return;
    }
    Diagnostic& d =
        report_.add("E012", place_here(), fmt::format("expected {}, found {}", end_word, shown(token())),
                    fmt::format("write {} where the {} ends", end_word, block));
    d.notes.push_back({opened, fmt::format("this {} is still open", block)});
}

}  // namespace nplc::seqc
