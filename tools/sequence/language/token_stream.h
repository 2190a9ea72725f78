#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnostics/report.h"
#include "language/ast.h"
#include "language/expected.h"
#include "language/names.h"
#include "language/token.h"

namespace nplc::seqc {

/// Whether the token is one of these words. For words that are wrong here: nothing is noted as expected.
bool is_one_of(const Token& token, std::initializer_list<std::string_view> words);

/// A token for messages: "'NEXT'", "the end of the file".
std::string shown(const Token& t);

inline ast::Name name_of(const Token& t) {
    return {t.text, t.span};
}

/// What a file declares, before and behind the place where it is asked for.
class DeclaredNames {
  public:
    explicit DeclaredNames(const std::vector<Token>& tokens);
    bool has_constant(std::string_view name) const { return holds(constants_, name); }
    bool has_input(std::string_view name) const { return holds(inputs_, name); }
    bool has_output(std::string_view name) const { return holds(outputs_, name); }
    /// A set-point at a register, too.
    bool has_register(std::string_view name) const { return holds(registers_, name); }

  private:
    using Sorted = std::vector<std::string>;  // in capital letters
    static bool holds(const Sorted& names, std::string_view name);
    void add_located(const std::vector<Token>& tokens, std::size_t at);

    Sorted constants_;
    Sorted inputs_;
    Sorted outputs_;
    Sorted registers_;
};

/// The tokens of a program, taken one after another; what is wrong with them is reported, and skipped or
/// mended.
class TokenStream {
  public:
    TokenStream(std::string_view source, std::vector<Token> tokens, Report& report);
    TokenStream(const TokenStream&) = delete;
    TokenStream& operator=(const TokenStream&) = delete;

    // The token here, and those ahead of it. Behind the last one there are only ends of the file.
    const Token& token(std::size_t ahead = 0) const {
        return file_.tokens[std::min(file_.at + ahead, file_.tokens.size() - 1)];
    }
    /// The token in front; the first one at the beginning.
    const Token& last() const { return file_.tokens[file_.at == 0 ? 0 : file_.at - 1]; }
    bool at(std::string_view word) const {
        if (Expected* expected = expected_here()) expected->words.push_back(word);
        return token().kind == TokenKind::identifier && same_name(token().text, word);
    }
    bool is_symbol_at(std::size_t ahead, std::string_view symbol) const {
        return token(ahead).kind == TokenKind::symbol && token(ahead).text == symbol;
    }
    bool at_symbol(std::string_view symbol) const { return is_symbol_at(0, symbol); }
    /// A word that can be a name.
    bool is_word_at(std::size_t ahead) const;
    bool at_end() const { return token().kind == TokenKind::end; }
    /// A keyword that skipping stops at, or the end.
    bool at_boundary() const;
    bool at_block_end(std::string_view end_word) const;
    /// '=' instead of ':='; '=:' becomes one token.
    bool at_equals();

    // Going on.
    void skip(std::size_t count = 1) { file_.at += count; }
    bool take(std::string_view word) {
        const bool is_here = at(word);
        if (is_here) skip();
        return is_here;
    }
    bool take_symbol(std::string_view symbol) {
        const bool is_here = at_symbol(symbol);
        if (is_here) skip();
        return is_here;
    }
    bool expect(std::string_view word, std::string_view where);
    bool expect_symbol(std::string_view symbol, std::string_view where);
    std::size_t position() const { return file_.at; }
    void return_to(std::size_t position) { file_.at = position; }
    /// Takes the semicolon. A missing one is reported at its place, and parsing continues as if it were
    /// there.
    void end_statement();
    /// Skips to the next statement or boundary.
    void recover();

    // Mistakes.
    Report& report() const { return report_; }
    void error_here(std::string_view expected, std::string help = {});
    /// The token, or the end of the last one at the end of the file.
    Span place_here() const;
    /// From this token to the last one.
    Span span_since(const Token& first) const;
    /// Reports a misspelt keyword and continues with the correct one; false if no word is similar.
    bool mend(const std::vector<std::string_view>& words, std::string_view expected);
    /// Continues as if this were written.
    void replace(std::string_view text, std::size_t ahead = 0) { file_.tokens[file_.at + ahead].text = text; }
    /// The token and the one behind it become one.
    void join(std::size_t index, std::string_view text);
    /// An unclosed comment, which was reported, may hold all that follows in the file.
    bool has_open_comment() const { return file_.comment_is_open; }
    bool in_open_comment() const { return has_open_comment() && at_end(); }
    /// The file ends, which was reported.
    bool end_was_reported();

    /// Counts parentheses and NOT; at_deepest() there may be no more of them.
    template <class Parse>
    bool nested(const Parse& parse) {
        ++depth_;
        const bool sound = parse();
        --depth_;
        return sound;
    }
    bool at_deepest() const { return depth_ == kDeepest; }

    // The place whose alternatives are asked for: null elsewhere.
    void collect(Expected& expected) { expected_ = &expected; }
    Expected* expected_here() const {
        return expected_ != nullptr && at_symbol(kPlace) ? expected_ : nullptr;
    }
    void note_place(ast::Role role) const;

    std::string_view source() const { return source_; }
    std::string_view text_of(Span span) const { return source_.substr(span.offset, span.length); }
    const std::vector<Token>& tokens() const { return file_.tokens; }
    const DeclaredNames& declared() const {
        if (!declared_) declared_.emplace(file_.tokens);
        return *declared_;
    }
    std::vector<Token> take_tokens() { return std::move(file_.tokens); }

    /// One file's tokens and how far they are taken.
    struct File {
        std::vector<Token> tokens;
        bool comment_is_open = false;
        std::size_t at = 0;
        bool end_was_reported = false;
    };
    /// Continues with another file, and returns the one before.
    File exchange(File file) {
        declared_.reset();
        return std::exchange(file_, std::move(file));
    }

  private:
    static constexpr int kDeepest = 100;

    std::string_view source_;
    Report& report_;
    File file_;
    mutable std::optional<DeclaredNames> declared_;  // of this file, once something asks for it
    int depth_ = 0;
    Expected* expected_ = nullptr;
};

/// Whether a line ends between these places in the source.
bool has_line_end(const TokenStream& in, std::size_t from, std::size_t to);

}  // namespace nplc::seqc
