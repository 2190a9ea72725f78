#pragma once

#include "compiler/scope.h"
#include "diagnostics/report.h"
#include "language/ast.h"

namespace nplc::seqc {

/// Reports probable omissions in a program whose lines are all valid: a timer that is never preset, a step
/// without exit, an error that is never reset.
void check_oversights(const ast::Program& program, const Plan& plan, const Symbols& symbols,
                      const std::vector<DeclaredSetPoint>& points, Report& report);

}  // namespace nplc::seqc
