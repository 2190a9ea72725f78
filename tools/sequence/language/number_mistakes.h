#pragma once

#include "language/token_stream.h"

namespace nplc::seqc {

/// Numbers that are written as elsewhere, or mistyped: one message at the number, none about what follows.
/// False if there is nothing of the kind; else parsing continues behind it.

/// 2x00, 12.5.3, .5, and 1 000 where no list separates numbers.
bool refuse_malformed_number(TokenStream& in, bool in_list);
/// T#0,8s, from its first part `literal` on, which is no time.
bool refuse_decimal_comma_in_time(TokenStream& in, const Token& literal);
/// 80,5 mm where no list separates numbers; 5 m m and 8O mm, where the second word is a unit and begins no
/// statement. `first` is the sign, if there is one, `number` the number.
bool refuse_rest_of_value(TokenStream& in, const Token& first, const Token& number, bool in_list);

}  // namespace nplc::seqc
