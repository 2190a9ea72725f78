#pragma once

#include "language/notes.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// What does not belong into a step, and what OUT does not have: one message says what is written instead.
/// False if there is nothing of the kind.

/// CONST in a step, which is skipped. An unclosed step looks the same: then a STEP comes before END_STEP.
bool refuse_item_inside(TokenStream& in, Notes& notes);
/// 2Go, read as one name. False: something else is here.
bool take_digits_first(TokenStream& in, ast::Name& name);
/// OUT SET Lamp;
bool refuse_out_of_set(TokenStream& in);
/// OUT Ready IF Start; OUT Ready AND Alarm; OUT Ready(S); the first is mended, and false.
bool refuse_out_tail(TokenStream& in);
/// OUT Lamp BLINK 1 s; continues with BLINKING.
void mend_blinking(TokenStream& in);
/// OUT Lamp BLINKING 1 s WHEN Shut;
bool refuse_behind_blinking(TokenStream& in);

}  // namespace nplc::seqc
