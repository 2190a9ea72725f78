#pragma once

#include <optional>
#include <vector>

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// Statements that end with a semicolon: NEXT, commands, values of registers, timer and counter, SET and
/// RESET, CALL and RETURN.
class StatementParser {
  public:
    StatementParser(TokenStream& in, Notes& notes, ValueParser& values)
        : in_(in), notes_(notes), values_(values) {}

    /// With its semicolon. After an error the rest of it is skipped.
    bool parse(ast::Statement& statement);
    /// The step behind NEXT :=
    bool parse_target(ast::Name& name);
    /// One output or several, separated by commas.
    bool parse_outputs(std::vector<ast::Name>& outputs);

  private:
    bool parse_simple(ast::Statement& statement);
    std::optional<bool> parse_named(ast::Statement& statement);
    bool parse_switched_outputs(ast::Statement& statement);
    bool parse_assignment(ast::Statement& statement);
    bool parse_arguments(ast::Statement& statement);
    bool parse_call(ast::Statement& statement);
    bool parse_called(ast::Statement& statement);
    bool parse_call_argument(std::vector<ast::Argument>& arguments);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
};

}  // namespace nplc::seqc
