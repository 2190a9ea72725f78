#pragma once

#include "compiler/scope.h"
#include "language/ast.h"

namespace nplc::seqc {

/// Adds `OUT Lamp IN Moving;` to the OUT of each step in it.
void spread_outputs(ast::Program& program, Scope& scope);

}  // namespace nplc::seqc
