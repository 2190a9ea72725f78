#pragma once

#include "diagnostics/report.h"
#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// What properties and assumptions name, as `tools/verify` will look it up. `is_whole`: all steps that the
/// compiler makes have their names.
void check_claims(const ast::Program& program, Scope& scope, bool is_whole, Report& report);

}  // namespace nplc::seqc
