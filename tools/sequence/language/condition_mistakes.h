#pragma once

#include "language/ast.h"
#include "language/token_stream.h"
#include "language/value_parser.h"

namespace nplc::seqc {

/// By how the manuals name them: V_SOLL, MODE_REG, CNTRL_BITS.
bool looks_like_register(std::string_view name);

/// What is no condition, although other languages have it: one message says what is written here instead.
/// False if there is nothing of the kind; else parsing continues behind it, `result` being a constant.

bool at_comparison(const TokenStream& in);
/// Start = 1, from its left side `first` on. `is_told`: what is wrong was reported already.
bool refuse_comparison(TokenStream& in, ValueParser& values, const Token& first, ast::Expression& result,
                       bool is_told);

/// R_TRIG(Start), TON1.Q, Motor.INPOS. Unless it `may_call`, a name and a ( are two conditions.
bool refuse_call_or_part(TokenStream& in, bool in_property, bool may_call);

/// STEP = Idle; RISING Start, unless a name is followed by another condition; NO ERROR.
bool refuse_foreign_condition(TokenStream& in, bool may_call, ast::Expression& result);

/// Start RISING, behind the name `first`.
bool refuse_edge_behind(TokenStream& in, const Token& first, ast::Expression& result);

/// UND, ODER, NICHT, ET, OU, NON; continues with the word of this language. `joins`: it stands between two.
void mend_foreign_word(TokenStream& in, bool joins);

/// A * B, A + B, A NAND B: continues behind the condition.
bool refuse_arithmetic(TokenStream& in);

/// TIMER2.Q; continues with TIMER.Q.
bool mend_numbered_timer(TokenStream& in);

/// AFTER 3 s
bool refuse_time_as_condition(TokenStream& in, ValueParser& values, bool in_property,
                              ast::Expression& result);

/// (NOT Warm FOR 1 s) OR Rain; FOR 200 ms Warm
bool refuse_misplaced_time(TokenStream& in, ValueParser& values);

}  // namespace nplc::seqc
