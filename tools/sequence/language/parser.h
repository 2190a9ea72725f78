#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostics/report.h"
#include "language/ast.h"
#include "language/lexer.h"
#include "language/notes.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// Parses a program's tokens. After an error it continues at the next statement, so that one run reports all
/// errors.
class Parser {
  public:
    Parser(std::string_view source, std::vector<Token> tokens, Report& report)
        : in_(source, std::move(tokens), report) {}
    /// A program with its includes. Without sources an INCLUDE is parsed and ignored.
    Parser(const Sources& sources, Report& report)
        : Parser(sources.text(), tokens_of(sources, sources.program(), report), report) {
        sources_ = &sources;
    }

    ast::Program parse();
    /// Parses the contents of an include file.
    ast::Program parse_part();
    /// Parses a file of properties: PROPERTY and ASSUME alone.
    ast::Program parse_claims();
    /// Whether this is an include file: it begins like one, and has no PROGRAM or END_PROGRAM.
    bool at_part() const { return at_item() && !is_program(); }

    /// Collects the alternatives at the token kPlace.
    void collect(Expected& expected) { in_.collect(expected); }

    /// Returns the tokens after parse(), with misspelt keywords corrected.
    std::vector<Token> take_tokens() { return in_.take_tokens(); }

  private:
    // parser.cpp: structure
    void twice(Span span, std::string_view what, Span first);
    void parse_item(ast::Program& program);
    void parse_scale(ast::Program& program);
    void parse_on(ast::Program& program);
    void parse_on_error(ast::Program& program);
    bool parse_names(std::vector<ast::Name>& names);
    void parse_group(ast::Program& program);
    void parse_constant(ast::Program& program);
    void parse_one_constant(ast::Program& program);
    void parse_variables(std::vector<ast::Variable>& variables, ast::Role role);
    void parse_variable(std::vector<ast::Variable>& variables, ast::Role role);
    bool parse_address(ast::Variable& variable, bool motor);
    void parse_step(ast::Program& program);
    void parse_power_up(ast::Program& program);
    void parse_step_body(ast::Step& step, std::string_view end_word);
    void parse_out(ast::Step& step);
    bool at_group_output() const;
    void parse_many_steps(ast::Program& program);
    void parse_group_output(ast::Program& program);
    void parse_allowance(ast::Step& step);
    bool parse_outputs(std::vector<ast::Name>& outputs);
    bool parse_out_tail(const Token& first, std::vector<ast::Name> outputs, ast::Step& step);

    // parse_includes.cpp
    void parse_include(ast::Program& program);
    void parse_file(const SourceFile& file, ast::Program& program);
    void parse_items(ast::Program& program);
    static void miss_names(ast::Program& program);
    bool at_item() const;
    bool is_program() const;
    void parse_headless(ast::Program& program);
    std::string help_of_headless() const;

    // parse_foreign.cpp: constructs of other languages
    /// Reports the correct form for a word such as WAIT or FOR; the parser is then at it, or behind its
    /// block.
    bool refuse_foreign_word();
    bool refuse_foreign_item(ast::Program& program);
    void mend_split_words();
    bool has_line_end(std::size_t from, std::size_t to) const;
    bool refuse_else_with_condition();
    bool refuse_not_in();
    bool refuse_bracket_before_names();
    bool refuse_semicolon_between_names();
    bool refuse_before_next();
    bool refuse_bare_arguments(const ast::Statement& statement);
    /// Skips to the next construct outside of a step.
    void recover_item();
    bool at_comparison() const;
    bool refuse_comparison(const Token& first, ast::Expression& result, bool is_told);
    bool refuse_call_or_part();
    void parse_step_head(ast::Program& program, ast::Step& step);

    // parse_mistakes.cpp: keywords in the wrong place
    /// Mends the first word of a statement. `end_words` are also allowed there.
    void mend_statement(std::vector<std::string_view> end_words);
    bool refuse_item_inside();
    bool refuse_set_of_value(ast::Statement& statement);
    bool refuse_entry_with_condition();
    bool refuse_out_tail();
    bool refuse_state(const ast::Statement& statement);
    bool mend_numbered_timer();
    bool refuse_time_as_condition(ast::Expression& result);
    bool refuse_modulo(ast::Value& value);
    bool expect_time(ast::Value& time, std::string_view word);

    // parse_misplaced.cpp: words where another one belongs
    bool refuse_misplaced_time();
    bool refuse_time_as_statement();
    bool refuse_condition_of_set(const ast::Statement& statement);
    bool refuse_out_of_set();
    void mend_blinking();
    bool refuse_behind_blinking();
    bool refuse_blinking_group();
    bool refuse_sequence_inside();
    void mend_constant_block(ast::Program& program);
    bool refuse_or_of_bits();

    // parse_statements.cpp
    bool parse_if(ast::Choice& choice);
    void parse_timing(ast::Branch& branch, bool is_first);
    void take_then();
    void parse_branch_body(ast::Branch& branch, Span opened);
    bool parse_statement(ast::Statement& statement);
    bool parse_target(ast::Name& name);
    bool parse_simple_statement(ast::Statement& statement);
    bool parse_switched_outputs(ast::Statement& statement);
    bool parse_assignment(ast::Statement& statement);
    bool parse_arguments(ast::Statement& statement);

    // parse_sequences.cpp
    void parse_sequence(ast::Program& program);
    bool parse_parameters(ast::Sequence& sequence);
    void skip_parameters();
    bool refuse_statement_outside();
    bool refuse_semicolon_between_parameters();
    bool parse_split_reset(ast::Statement& statement);
    std::optional<bool> parse_named_statement(ast::Statement& statement);
    bool parse_call(ast::Statement& statement);
    bool parse_called(ast::Statement& statement);
    void refuse_every_scan(const ast::Statement& statement, std::string_view word);
    bool parse_call_argument(std::vector<ast::Argument>& arguments);

    // parse_values.cpp
    bool parse_value(ast::Value& value);
    bool parse_sum(ast::Value& value);
    bool parse_product(ast::Value& value);
    bool parse_factor(ast::Value& value);
    bool parse_named_value(ast::Value& value);
    static ast::Value wrapped(ast::Value::Kind kind, ast::Value operand);
    bool parse_literal(ast::Value& value);
    bool parse_register_number(std::optional<ast::Value>& number);
    void parse_unit(ast::Value& value);
    bool refuse_decimal_comma(const Token& first);
    bool refuse_decimal_comma_in_time(const Token& literal);
    bool parse_raw_term(std::vector<ast::RawTerm>& terms);

    // parse_expressions.cpp
    bool at_symbolic_term() const;
    bool parse_symbolic_term(const Token& first, std::vector<ast::RawTerm>& terms);
    void parse_symbolic_body(ast::SymbolicTerm& term);

    // parse_expressions.cpp
    bool parse_expression(ast::Expression& result);
    bool parse_operators(ast::Expression& result, std::size_t level);
    bool parse_primary(ast::Expression& result);
    bool parse_named_primary(ast::Expression& result);
    bool at_edge() const;
    bool parse_edge(ast::Expression& result);

    // parse_set_points.cpp
    void parse_set_point(ast::Program& program);
    bool parse_set_point_place(ast::SetPoint& point);
    bool parse_range(ast::SetPoint& point);
    bool parse_bound(ast::Value& value);
    bool goes_on_in_line() const;
    void leave_set_point();
    void parse_takes(ast::Step& step);

    // parse_properties.cpp
    using Form = ast::Claim::Form;
    void parse_property(ast::Program& program);
    void parse_assumption(ast::Program& program);
    void finish_claim(const Token& first, bool is_sound, ast::Program& program);
    void recover_claim();
    bool refuse_claim(std::string_view word);
    bool begins_no_claim() const;
    bool parse_form();
    bool parse_never();
    bool parse_whenever();
    bool parse_between();
    bool parse_condition_first();
    bool parse_only();
    bool parse_assumed();
    bool as(Form form) {
        claim_.form = form;
        return true;
    }
    bool parse_condition();
    bool parse_single_condition();
    bool parse_claimed_time();
    bool parse_step_test(ast::Expression& result);
    bool parse_step_name(ast::Expression& result);
    bool at_step_test() const;

    TokenStream in_;
    Notes notes_{in_};
    const Sources* sources_ = nullptr;
    bool in_property_ = false;
    bool in_claims_file_ = false;    ///< words of the language can be names of properties there
    ast::Claim claim_;               ///< the property being parsed
    std::size_t claim_begin_ = 0;    ///< its first token behind PROPERTY Name:
    bool before_condition_ = false;  ///< another condition follows: its ( is no call
    bool in_term_ = false;
    bool in_value_ = false;
};

}  // namespace nplc::seqc
