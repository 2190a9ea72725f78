#pragma once

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "seqc/seqc.h"
#include "seqc/sources.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// Values of the motor that nothing selects, and names that nothing uses.
void check_unused(const ast::Program& program, const Plan& plan, const Sources& sources,
                  const Symbols& symbols, Report& report);

}  // namespace nplc::seqc
