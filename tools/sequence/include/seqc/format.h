#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

struct Formatted {
    std::string text;                     ///< the formatted program; empty if not `ok`
    std::vector<Diagnostic> diagnostics;  ///< syntax errors in source order, 100 at most
    bool more_diagnostics = false;        ///< there were more than 100
    std::string fault;                    ///< the formatter's own check failed: a bug of seqc
    bool ok = false;
};

/// Formats the text of one program: the same words, except for case, and the same comments in the same order.
/// Formatting the result again changes nothing. The program's meaning is not checked. Accepts any bytes;
/// never throws on bad input.
Formatted format_program(std::string_view source);

}  // namespace nplc::seqc
