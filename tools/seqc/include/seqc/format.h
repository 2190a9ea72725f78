#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

struct Formatted {
    std::string text;                     ///< the program in the one style; empty if not `ok`
    std::vector<Diagnostic> diagnostics;  ///< what the grammar does not allow; in source order, 100 at most
    bool more_diagnostics = false;        ///< there were more than 100
    std::string fault;                    ///< the formatter's own check failed: a fault of seqc
    bool ok = false;
};

/// Lays out the text of one program: the same words, the case of some of them apart, and the same comments in
/// the same order. Formatting the result changes nothing. What the words mean is not looked into. Takes any
/// bytes; never throws on bad input.
Formatted format_program(std::string_view source);

}  // namespace nplc::seqc
