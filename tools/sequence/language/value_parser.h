#pragma once

#include <optional>
#include <utility>

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// Numbers with their units, times, names of constants, and arithmetic on them.
class ValueParser {
  public:
    ValueParser(TokenStream& in, Notes& notes) : in_(in), notes_(notes) {}

    /// Arithmetic, or one value.
    bool parse(ast::Value& value);
    /// One number or time. In a list a comma separates two of them.
    bool parse_literal(ast::Value& value, bool in_list = false);
    /// (33) behind REG.
    bool parse_register_number(std::optional<ast::Value>& number);
    /// The unit behind a number, if there is one.
    void parse_unit(ast::Value& value);
    /// The time behind `word`.
    bool expect_time(ast::Value& time, std::string_view word);

  private:
    bool parse_sum(ast::Value& value);
    bool parse_product(ast::Value& value);
    bool parse_factor(ast::Value& value);
    bool parse_name(ast::Value& value);
    bool refuse_modulo(ast::Value& value);

    TokenStream& in_;
    Notes& notes_;
    bool in_arithmetic_ = false;
};

}  // namespace nplc::seqc
