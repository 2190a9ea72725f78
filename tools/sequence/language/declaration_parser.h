#pragma once

#include <vector>

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// MOTOR, SCALE, CONST and the blocks of variables.
class DeclarationParser {
  public:
    DeclarationParser(TokenStream& in, Notes& notes, ValueParser& values)
        : in_(in), notes_(notes), values_(values) {}

    // Each is at its keyword and adds what is declared to the program.
    void parse_motor(ast::Program& program);
    void parse_scale(ast::Program& program);
    void parse_constant(ast::Program& program);
    /// VAR_INPUT, VAR_OUTPUT or VAR_MOTOR; `role` is that of its names.
    void parse_variables(std::vector<ast::Variable>& variables, ast::Role role);

  private:
    void parse_one_constant(ast::Program& program);
    void mend_constant_block(ast::Program& program);
    void parse_variable(std::vector<ast::Variable>& variables, ast::Role role);
    bool parse_address(ast::Variable& variable, bool motor);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
};

}  // namespace nplc::seqc
