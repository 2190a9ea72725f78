#pragma once

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// Conditions: of branches, outputs and single terms, or those of properties, which test the step as well and
/// have no edges.
class ExpressionParser {
  public:
    ExpressionParser(TokenStream& in, Notes& notes, ValueParser& values, bool in_property = false)
        : in_(in), notes_(notes), values_(values), in_property_(in_property) {}

    bool parse(ast::Expression& result) { return parse_operators(result, 0); }
    /// Without AND, OR and XOR outside of parentheses. If another one follows, a ( behind its name belongs to
    /// that.
    bool parse_single(ast::Expression& result, bool another_follows = false);

  private:
    bool parse_operators(ast::Expression& result, std::size_t level);
    bool parse_primary(ast::Expression& result);
    bool parse_named_primary(ast::Expression& result);
    bool parse_edge(ast::Expression& result);
    bool parse_step_test(ast::Expression& result);
    bool parse_step_name(ast::Expression& result);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
    bool in_property_;
    bool another_follows_ = false;
};

}  // namespace nplc::seqc
