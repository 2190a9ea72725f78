#pragma once

#include "language/ast.h"
#include "language/notes.h"
#include "language/step_parser.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// SEQUENCE Name(parameters) steps END_SEQUENCE
class SequenceParser {
  public:
    SequenceParser(TokenStream& in, Notes& notes, StepParser& steps)
        : in_(in), notes_(notes), steps_(steps) {}

    /// At SEQUENCE; adds it to the program.
    void parse(ast::Program& program);

  private:
    bool parse_parameters(ast::Sequence& sequence);

    TokenStream& in_;
    Notes& notes_;
    StepParser& steps_;
};

}  // namespace nplc::seqc
