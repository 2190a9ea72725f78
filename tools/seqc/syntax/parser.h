#pragma once

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostics/report.h"
#include "syntax/ast.h"
#include "syntax/token.h"

namespace nplc::seqc {

/// Reads a program's tokens. After an error it goes on at the next statement, so that one run shows them all.
class Parser {
  public:
    Parser(std::string_view source, std::vector<Token> tokens, Report& report)
        : source_(source),
          tokens_(std::move(tokens)),
          report_(report),
          comment_is_open_(report.has("E002")) {}

    ast::Program parse();

    /// The tokens back, after parse(); misspelt keywords are mended in them.
    std::vector<Token> take_tokens() { return std::move(tokens_); }

  private:
    // parse_tokens.cpp
    const Token& token(std::size_t ahead = 0) const;
    bool at(std::string_view word) const;
    bool at_symbol(std::string_view symbol) const;
    bool take(std::string_view word);
    bool take_symbol(std::string_view symbol);
    bool expect(std::string_view word, std::string_view where);
    bool expect_symbol(std::string_view symbol, std::string_view where);
    bool expect_name(ast::Name& name, std::string_view what);
    Span place_here() const;
    void error_here(std::string_view expected, std::string help = {});
    /// Reports a misspelt keyword and goes on as if it were right; false if no word is near.
    bool mend(const std::vector<std::string_view>& words, std::string_view expected);
    /// The same for the word that a statement begins with. `end_words` may stand there too.
    void mend_statement(std::vector<std::string_view> end_words);
    bool is_word_at(std::size_t ahead) const;
    /// What is missing here stands in a comment that is never closed, which was reported.
    bool in_open_comment() const { return comment_is_open_ && token().kind == TokenKind::end; }
    /// The file ends, and that was reported.
    bool end_was_reported();
    void end_statement();
    void recover();
    bool at_boundary() const;
    bool at_block_end(std::string_view end_word) const;
    void end_block(std::string_view end_word, Span opened);
    Span span_since(const Token& first) const;
    ast::Name name_of(const Token& t) const { return {t.text, t.span}; }

    // parser.cpp: structure
    void twice(Span span, std::string_view what, Span first);
    void parse_item(ast::Program& program);
    void parse_scale(ast::Program& program);
    void parse_on(ast::Program& program);
    void parse_on_error(ast::Program& program);
    bool parse_names(std::vector<ast::Name>& names, std::string_view what);
    void parse_group(ast::Program& program);
    void parse_variables(std::vector<ast::Variable>& variables, bool motor);
    void parse_variable(std::vector<ast::Variable>& variables, bool motor);
    void parse_step(ast::Program& program);
    void parse_power_up(ast::Program& program);
    void parse_step_body(ast::Step& step, std::string_view end_word);
    void parse_out(ast::Step& step);
    void parse_allowance(ast::Step& step);
    bool parse_outputs(std::vector<ast::Name>& outputs);

    // parse_foreign.cpp: what other languages have
    bool is_symbol_at(std::size_t ahead, std::string_view symbol) const;
    /// Says what to write for a word such as WAIT or FOR; reading stands at it, or behind its block.
    bool refuse_foreign_word();
    bool refuse_foreign_item(ast::Program& program);
    /// To the next thing that may stand outside of a step.
    void recover_item();
    bool at_comparison() const;
    bool refuse_comparison(const Token& first, ast::Expression& result);
    bool refuse_call_or_part();
    void parse_step_head(ast::Program& program, ast::Step& step);

    // parse_statements.cpp
    bool parse_if(ast::Choice& choice);
    void take_then();
    void parse_branch_body(ast::Branch& branch, Span opened);
    bool parse_statement(ast::Statement& statement);
    bool parse_target(ast::Name& name);
    bool parse_simple_statement(ast::Statement& statement);
    bool parse_assignment(ast::Statement& statement);
    bool parse_arguments(ast::Statement& statement);
    bool parse_register_number(std::optional<ast::Value>& number);
    bool parse_value(ast::Value& value);
    void parse_unit(ast::Value& value);
    bool refuse_decimal_comma(const Token& first);
    bool parse_raw_term(std::vector<ast::RawTerm>& terms);

    // parse_terms.cpp
    bool at_symbolic_term() const;
    bool parse_symbolic_term(const Token& first, std::vector<ast::RawTerm>& terms);
    void parse_symbolic_body(ast::SymbolicTerm& term);

    // parse_expressions.cpp
    bool parse_expression(ast::Expression& result);
    bool parse_operators(ast::Expression& result, std::size_t level);
    bool parse_primary(ast::Expression& result);
    bool parse_named_primary(ast::Expression& result);

    // parse_properties.cpp
    void parse_property(ast::Program& program);
    bool parse_claim();
    bool parse_whenever();
    void parse_assumption(ast::Program& program);
    void add_claim(const Token& first, ast::Program& program);
    bool parse_step_test();

    static constexpr int kDeepest = 100;

    std::string_view source_;
    std::vector<Token> tokens_;
    Report& report_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::deque<std::string> texts_;
    std::vector<std::string_view> faulty_names_;
    bool names_missing_ = false;
    bool comment_is_open_;
    bool end_reported_ = false;
    bool in_property_ = false;
    bool in_term_ = false;
};

/// Milliseconds of T#1s500ms; false if it is malformed.
bool parse_time(std::string_view text, double& milliseconds);

/// A token as messages show it: "'NEXT'", "the end of the file".
std::string shown(const Token& t);

/// Words that cannot be names.
bool is_reserved(std::string_view word);
std::span<const std::string_view> reserved_words();

/// Whether a text can be a name: letters, digits and underscores, and no word of the language.
bool is_name(std::string_view text);

}  // namespace nplc::seqc
