#pragma once

#include "compiler/memory.h"
#include "compiler/scope.h"
#include "language/ast.h"

namespace nplc::seqc {

/// The memory that the step's conditions and outputs need of earlier scans; reports conflicts: two users of
/// the timer, edges of a signal that is no input.
Memory memory_of(const ast::Step& step, Scope& scope);

/// Checks outputs that SET and RESET switch: none may be in an OUT, and each needs both.
void check_latched_outputs(const ast::Program& program, Scope& scope);

}  // namespace nplc::seqc
