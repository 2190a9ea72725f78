#pragma once

#include <vector>

#include "language/ast.h"
#include "language/expression_parser.h"
#include "language/notes.h"
#include "language/statement_parser.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// TERM: a term of the table, as its bytes or in symbols.
class TermParser {
  public:
    TermParser(TokenStream& in, Notes& notes, ValueParser& values, ExpressionParser& conditions,
               StatementParser& statements)
        : in_(in), notes_(notes), values_(values), conditions_(conditions), statements_(statements) {}

    /// At TERM; false if the rest of it is to be skipped.
    bool parse(std::vector<ast::RawTerm>& terms);

  private:
    bool parse_symbolic(const Token& first, std::vector<ast::RawTerm>& terms);
    void parse_symbolic_body(ast::SymbolicTerm& term);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
    ExpressionParser& conditions_;
    StatementParser& statements_;
};

}  // namespace nplc::seqc
