#pragma once

#include "format/item.h"

namespace nplc::seqc::layout {

/// Marks the language's words and gives every word its case: keywords, commands, registers and addresses as
/// in the manual and the README, names as where they are declared. Words that nothing knows stay as they are.
void spell(Document& document);

}  // namespace nplc::seqc::layout
