#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "language/ast.h"
#include "language/expression_parser.h"
#include "language/notes.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// PROPERTY Name: claim; and ASSUME claim;
class PropertyParser {
  public:
    PropertyParser(TokenStream& in, Notes& notes, ValueParser& values)
        : in_(in), notes_(notes), values_(values), conditions_(in, notes, values, true) {}

    /// At PROPERTY; adds it to the program.
    void parse(ast::Program& program);
    /// At ASSUME.
    void parse_assumption(ast::Program& program);
    /// A file of these alone. Words of the language can be names of properties there.
    void parse_file(ast::Program& program);

  private:
    using Form = ast::Claim::Form;

    void finish_claim(const Token& first, bool is_sound, ast::Program& program);
    bool parse_form();
    bool parse_never();
    bool parse_whenever();
    bool parse_between();
    /// One of the words stands here, behind a condition of BETWEEN.
    bool refuse_joined(std::initializer_list<std::string_view> words);
    bool parse_condition_first();
    bool parse_only();
    bool parse_assumed();
    bool as(Form form) {
        claim_.form = form;
        return true;
    }
    bool parse_condition();
    bool parse_single_condition(bool another_follows = false);
    bool parse_time();

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
    ExpressionParser conditions_;
    ast::Claim claim_;             ///< the one being parsed
    std::size_t claim_begin_ = 0;  ///< its first token behind PROPERTY Name:
    bool in_claims_file_ = false;
};

}  // namespace nplc::seqc
