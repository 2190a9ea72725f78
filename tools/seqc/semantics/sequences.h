#pragma once

#include "diagnostics/report.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// Puts the steps of each SEQUENCE in the place of its calls: a set of steps for each combination of
/// arguments and place to go on at. They stand behind the program's steps, and the sequence's name becomes a
/// group of them. Reports calls that do not fit, and RETURN elsewhere.
void expand_sequences(ast::Program& program, Report& report);

}  // namespace nplc::seqc
