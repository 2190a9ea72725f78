#include "language/token_stream.h"

#include <fmt/format.h>

#include "language/reserved_words.h"

namespace nplc::seqc {

std::string shown(const Token& t) {
    if (t.kind == TokenKind::end) return "the end of the file";
    return t.text.size() <= 40 ? fmt::format("'{}'", t.text) : fmt::format("'{}...'", t.text.substr(0, 37));
}

bool is_one_of(const Token& token, std::initializer_list<std::string_view> words) {
    return token.kind == TokenKind::identifier &&
           std::ranges::any_of(words, [&](std::string_view word) { return same_name(token.text, word); });
}

TokenStream::TokenStream(std::string_view source, std::vector<Token> tokens, Report& report)
    : source_(source),
      report_(report),
      file_{.tokens = std::move(tokens), .comment_is_open = report.has("E002")} {}

DeclaredNames::DeclaredNames(const std::vector<Token>& tokens) {
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (is_one_of(tokens[i], {"CONST"})) constants_.push_back(upper(tokens[i + 1].text));
        if (is_one_of(tokens[i + 1], {"AT"})) add_located(tokens, i);
    }
    for (Sorted* names : {&constants_, &inputs_, &outputs_, &registers_})
        std::sort(names->begin(), names->end());
}

/// NAME AT IN2, NAME AT NOT %IX0.2, NAME AT V1; not STEP NAME AT 5.
void DeclaredNames::add_located(const std::vector<Token>& tokens, std::size_t at) {
    const std::size_t place = at + 2 < tokens.size() && is_one_of(tokens[at + 2], {"NOT"}) ? at + 3 : at + 2;
    if (place >= tokens.size() || tokens[place].kind == TokenKind::number) return;
    const std::string address = upper(tokens[place].text);
    const auto is_terminal = [&](std::string_view word, std::string_view located) {
        return address.starts_with(located) ||
               (address.size() == word.size() + 1 && address.starts_with(word) && address.back() <= '9');
    };
    Sorted& names = is_terminal("IN", "%I") ? inputs_ : is_terminal("OUT", "%Q") ? outputs_ : registers_;
    names.push_back(upper(tokens[at].text));
}

bool DeclaredNames::holds(const Sorted& names, std::string_view name) {
    return std::binary_search(names.begin(), names.end(), upper(name));
}

bool TokenStream::is_word_at(std::size_t ahead) const {
    return token(ahead).kind == TokenKind::identifier && !is_reserved(token(ahead).text);
}

bool TokenStream::at_boundary() const {
    return at_end() || (token().kind == TokenKind::identifier && is_boundary(token().text));
}

bool TokenStream::at_block_end(std::string_view end_word) const {
    return at_end() || at(end_word) || at("END_PROGRAM");
}

bool TokenStream::at_equals() {
    if (!at_symbol("=")) return false;
    const Span equals = token().span;
    if (is_symbol_at(1, ":") && token(1).span.offset == equals.offset + equals.length) {
        skip();
        replace("=:");
        file_.tokens[file_.at].span = {equals.offset, equals.length + token().span.length};
    }
    return true;
}

bool TokenStream::expect(std::string_view word, std::string_view where) {
    if (take(word)) return true;
    const std::string expected = fmt::format("{} {}", word, where);
    if (mend({word}, expected)) return take(word);
    error_here(expected);
    return false;
}

bool TokenStream::expect_symbol(std::string_view symbol, std::string_view where) {
    if (take_symbol(symbol)) return true;
    const bool only_equals = symbol == ":=" && at_equals();
    error_here(fmt::format("'{}' {}", symbol, where), only_equals ? "write := with a colon" : "");
    if (only_equals) skip();
    return only_equals;
}

void TokenStream::end_statement() {
    if (take_symbol(";") || in_open_comment() || end_was_reported()) return;
    report_.add("E010", {last().span.offset + last().span.length, 1},
                fmt::format("expected ';' before {}", shown(token())),
                "every statement ends with a semicolon");
    if (token().kind == TokenKind::identifier && token().span.offset > 0 && !at("ERROR")) return;
    recover();
}

void TokenStream::recover() {
    while (!at_boundary()) {
        if (take_symbol(";")) return;
        skip();
    }
}

void TokenStream::error_here(std::string_view expected, std::string help) {
    if (in_open_comment() || end_was_reported()) return;
    report_.add("E010", place_here(), fmt::format("expected {}, found {}", expected, shown(token())),
                std::move(help));
}

Span TokenStream::place_here() const {
    if (!at_end() || file_.at == 0) return token().span;
    return {last().span.offset + last().span.length, 1};
}

Span TokenStream::span_since(const Token& first) const {
    const std::uint32_t end =
        std::max(first.span.offset + first.span.length, last().span.offset + last().span.length);
    return {first.span.offset, end - first.span.offset};
}

bool TokenStream::mend(const std::vector<std::string_view>& words, std::string_view expected) {
    if (!is_word_at(0) || token().text.size() < 2) return false;
    const std::string_view meant = nearest(token().text, words);
    if (meant.empty()) return false;
    error_here(expected, suggestion(token().text, words));
    replace(meant);
    return true;
}

void TokenStream::join(std::size_t index, std::string_view text) {
    std::vector<Token>& tokens = file_.tokens;
    const Span end = tokens[index + 1].span;
    tokens[index].span.length = end.offset + end.length - tokens[index].span.offset;
    tokens[index].text = text;
    tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(index) + 1);
}

bool TokenStream::end_was_reported() {
    if (!at_end()) return false;
    return std::exchange(file_.end_was_reported, true);
}

void TokenStream::note_place(ast::Role role) const {
    if (Expected* expected = expected_here()) expected->names.push_back(role);
}

bool has_line_end(const TokenStream& in, std::size_t from, std::size_t to) {
    return in.source().substr(from, to - from).find('\n') != std::string_view::npos;
}

}  // namespace nplc::seqc
