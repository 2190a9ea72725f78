#pragma once

#include "language/ast.h"
#include "language/expression_parser.h"
#include "language/notes.h"
#include "language/statement_parser.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// IF with its ELSIFs, ELSE and END_IF.
class ChoiceParser {
  public:
    ChoiceParser(TokenStream& in, Notes& notes, ValueParser& values, ExpressionParser& conditions,
                 StatementParser& statements)
        : in_(in), notes_(notes), values_(values), conditions_(conditions), statements_(statements) {}

    void parse(ast::Choice& choice);

  private:
    void parse_timing(ast::Branch& branch, bool is_first);
    void parse_branch_body(ast::Branch& branch, Span opened);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
    ExpressionParser& conditions_;
    StatementParser& statements_;
};

}  // namespace nplc::seqc
