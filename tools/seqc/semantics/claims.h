#pragma once

#include "diagnostics/report.h"
#include "semantics/scope.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// Resolves the names in properties and assumptions as `tools/verify` will. `is_whole`: all
/// compiler-generated steps have their names.
void check_claims(const ast::Program& program, Scope& scope, bool is_whole, Report& report);

}  // namespace nplc::seqc
