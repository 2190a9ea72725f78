#pragma once

#include "diagnostics/report.h"
#include "language/ast.h"

namespace nplc::seqc {

/// Replaces the calls of each SEQUENCE by its steps: one set of steps for each combination of arguments and
/// return step. They follow the program's steps, and the sequence's name becomes a group of them. Reports
/// invalid calls, and RETURN elsewhere.
void expand_sequences(ast::Program& program, Report& report);

}  // namespace nplc::seqc
