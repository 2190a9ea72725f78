#pragma once

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// SET_POINT Name AT register := value RANGE low .. high STEP step;
class SetPointParser {
  public:
    SetPointParser(TokenStream& in, Notes& notes, ValueParser& values)
        : in_(in), notes_(notes), values_(values) {}

    /// At SET_POINT; adds it to the program.
    void parse(ast::Program& program);

  private:
    bool parse_place(ast::SetPoint& point);
    bool parse_range(ast::SetPoint& point);
    bool parse_bound(ast::Value& value);

    TokenStream& in_;
    Notes& notes_;
    ValueParser& values_;
};

}  // namespace nplc::seqc
