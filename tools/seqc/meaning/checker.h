#pragma once

#include "meaning/model.h"
#include "meaning/scope.h"
#include "syntax/ast.h"
#include "syntax/report.h"

namespace nplc::seqc {

/// From the program as written to rules that never hold together; reports what would surprise.
Plan check(const ast::Program& program, Scope& scope, Report& report);

/// Follows the motor's mode from step to step: what would start it towards an old target, or not at all.
void check_motor_state(const Plan& plan, Report& report);

}  // namespace nplc::seqc
