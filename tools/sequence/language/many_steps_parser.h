#pragma once

#include <vector>

#include "language/ast.h"
#include "language/expression_parser.h"
#include "language/notes.h"
#include "language/statement_parser.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// What concerns many steps: ON condition, ON ERROR, GROUP, and OUT .. IN.
class ManyStepsParser {
  public:
    ManyStepsParser(TokenStream& in, Notes& notes, ExpressionParser& conditions, StatementParser& statements)
        : in_(in), notes_(notes), conditions_(conditions), statements_(statements) {}

    // Each is at its first word and adds the construct to the program.
    void parse_on(ast::Program& program);
    void parse_group(ast::Program& program);
    /// Whether OUT here is one for many steps.
    bool at_group_output() const;
    void parse_group_output(ast::Program& program);

  private:
    void parse_on_error(ast::Program& program);
    bool parse_names(std::vector<ast::Name>& names);

    TokenStream& in_;
    Notes& notes_;
    ExpressionParser& conditions_;
    StatementParser& statements_;
};

}  // namespace nplc::seqc
