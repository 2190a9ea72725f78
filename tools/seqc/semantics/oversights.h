#pragma once

#include "diagnostics/report.h"
#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// What a program most likely forgot although each of its lines is right: a timer that is never set, a step
/// without exit, an error that is never reset.
void check_oversights(const ast::Program& program, const Plan& plan, const Symbols& symbols,
                      const std::vector<DeclaredSetPoint>& points, Report& report);

}  // namespace nplc::seqc
