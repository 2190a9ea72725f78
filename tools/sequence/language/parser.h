#pragma once

#include <vector>

#include "diagnostics/report.h"
#include "language/ast.h"
#include "language/declaration_parser.h"
#include "language/expression_parser.h"
#include "language/lexer.h"
#include "language/many_steps_parser.h"
#include "language/notes.h"
#include "language/property_parser.h"
#include "language/sequence_parser.h"
#include "language/set_point_parser.h"
#include "language/statement_parser.h"
#include "language/step_parser.h"
#include "language/term_parser.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// Parses a program's tokens. After an error it continues at the next statement, so that one run reports all
/// errors. Each kind of construct has a parser of its own, and all of them take from the same tokens.
class Parser {
  public:
    Parser(std::string_view source, std::vector<Token> tokens, Report& report)
        : in_(source, std::move(tokens), report) {}
    /// A program with its includes. Without sources an INCLUDE is parsed and ignored.
    Parser(const Sources& sources, Report& report)
        : Parser(sources.text(), tokens_of(sources, sources.program(), report), report) {
        sources_ = &sources;
    }

    ast::Program parse();
    /// Parses the contents of an include file.
    ast::Program parse_part();
    /// Parses a file of properties: PROPERTY and ASSUME alone.
    ast::Program parse_claims();
    /// Whether this is an include file: it begins like one, and has no PROGRAM or END_PROGRAM.
    bool at_part() const;

    /// Collects the alternatives at the token kPlace.
    void collect(Expected& expected) { in_.collect(expected); }

    /// Returns the tokens after parse(), with misspelt keywords corrected.
    std::vector<Token> take_tokens() { return in_.take_tokens(); }

  private:
    void parse_headless(ast::Program& program);
    void parse_items(ast::Program& program);
    void parse_item(ast::Program& program);
    void parse_include(ast::Program& program);
    void parse_file(const SourceFile& file, ast::Program& program);

    TokenStream in_;
    Notes notes_{in_};
    ValueParser values_{in_, notes_};
    ExpressionParser conditions_{in_, notes_, values_};
    StatementParser statements_{in_, notes_, values_};
    TermParser terms_{in_, notes_, values_, conditions_, statements_};
    StepParser steps_{in_, notes_, values_, conditions_, statements_, terms_};
    SequenceParser sequences_{in_, notes_, steps_};
    DeclarationParser declarations_{in_, notes_, values_};
    SetPointParser set_points_{in_, notes_, values_};
    ManyStepsParser many_steps_{in_, notes_, conditions_, statements_};
    PropertyParser properties_{in_, notes_, values_};
    const Sources* sources_ = nullptr;
};

}  // namespace nplc::seqc
