#pragma once

#include <string_view>
#include <vector>

#include "language/ast.h"
#include "language/notes.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// Mends a misspelt first word of a statement. `end_words` are also allowed there.
void mend_statement(TokenStream& in, const Notes& notes, std::vector<std::string_view> end_words);

/// Statements as other languages have them, words of this one in the wrong place, and parts that a statement
/// does not have: one message says what is written instead. False if there is nothing of the kind.

/// WAIT, FOR and others; continues at the word, or behind its block.
bool refuse_foreign_word(TokenStream& in);
/// NEXT := Hold; WITHIN T#3s ELSE
bool refuse_time_as_statement(TokenStream& in);
/// POSITION Press;
bool refuse_bare_arguments(TokenStream& in, const ast::Statement& statement);
/// STATE := 3;
bool refuse_state(TokenStream& in, const Notes& notes, const ast::Statement& statement);
/// SET V_SOLL := 100; SET POSITION 80 mm;
bool refuse_set_of_value(TokenStream& in, ast::Statement& statement);
/// N Lamp; D T#3s Lamp; as the actions of a chart.
bool refuse_qualifier(TokenStream& in);
/// -> Work; (Lamp) ERROR := 0; WHEN Start NEXT := Work;
bool refuse_no_statement(TokenStream& in);
/// SET(Lamp); RESET;
bool refuse_switch_without_name(TokenStream& in);
/// P_SOLL += 100; Lamp++;
bool refuse_reckoning(TokenStream& in, const ast::Statement& statement);
/// Lamp := ON; Lamp = Start;
bool refuse_level(TokenStream& in, const ast::Statement& statement);
/// SET Lamp WHEN Shut;
bool refuse_condition_of_set(TokenStream& in, const ast::Statement& statement);
/// CNTRL_BITS := HICLK OR INPSIGN;
bool refuse_or_of_bits(TokenStream& in);

}  // namespace nplc::seqc
