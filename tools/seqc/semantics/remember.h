#pragma once

#include "semantics/memory.h"
#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// What the step's conditions and outputs ask it to know of earlier scans; reports what cannot be: two that
/// use the timer, edges of what is no input.
Memory memory_of(const ast::Step& step, Scope& scope);

/// Outputs that SET and RESET switch: none of them may stand in an OUT, and each needs both.
void check_latched_outputs(const ast::Program& program, Scope& scope);

}  // namespace nplc::seqc
