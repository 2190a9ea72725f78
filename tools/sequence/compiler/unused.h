#pragma once

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "language/ast.h"
#include "seqc/seqc.h"
#include "seqc/sources.h"

namespace nplc::seqc {

/// Reports values of the motor that no command selects, and unused names.
void check_unused(const ast::Program& program, const Plan& plan, const Sources& sources,
                  const Symbols& symbols, Report& report);

}  // namespace nplc::seqc
