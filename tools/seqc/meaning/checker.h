#pragma once

#include "meaning/model.h"
#include "meaning/scope.h"
#include "syntax/ast.h"
#include "syntax/report.h"

namespace nplc::seqc {

/// From the program as written to rules that never hold together; reports what would surprise.
Plan check(const ast::Program& program, Scope& scope, Report& report);

/// Follows the motor's mode from step to step: what would start it towards an old target, or not at all, and
/// what waits for an INPOS that never comes.
void check_motor_state(const Plan& plan, registers::Model model, Report& report);

/// Limits of the motor that a program sets, although reaching them does not show in ERROR (001 §5.2.1.6).
void check_invisible_limits(const Plan& plan, registers::Model model, Report& report);

}  // namespace nplc::seqc
