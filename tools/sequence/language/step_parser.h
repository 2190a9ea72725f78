#pragma once

#include <string_view>
#include <vector>

#include "language/ast.h"
#include "language/choice_parser.h"
#include "language/expression_parser.h"
#include "language/notes.h"
#include "language/statement_parser.h"
#include "language/term_parser.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// STEP and POWER_UP with what stands in them.
class StepParser {
  public:
    StepParser(TokenStream& in, Notes& notes, ValueParser& values, ExpressionParser& conditions,
               StatementParser& statements, TermParser& terms)
        : in_(in),
          notes_(notes),
          values_(values),
          conditions_(conditions),
          statements_(statements),
          terms_(terms),
          choices_(in, notes, values, conditions, statements) {}

    /// At STEP; adds it to the program.
    void parse(ast::Program& program);
    /// At POWER_UP.
    void parse_power_up(ast::Program& program);

  private:
    void parse_head(ast::Program& program, ast::Step& step);
    void parse_body(ast::Step& step, std::string_view end_word);
    bool refuse_entry_with_condition();
    bool refuse_entry_of_outputs(ast::Step& step);
    void parse_out(ast::Step& step);
    bool parse_out_tail(const Token& first, std::vector<ast::Name> outputs, ast::Step& step);
    void parse_allowance(ast::Step& step);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
    ExpressionParser& conditions_;
    StatementParser& statements_;
    TermParser& terms_;
    ChoiceParser choices_;
};

}  // namespace nplc::seqc
