#pragma once

#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// `OUT Lamp IN Moving;` becomes a part of the OUT of each step that it names.
void spread_outputs(ast::Program& program, Scope& scope);

}  // namespace nplc::seqc
