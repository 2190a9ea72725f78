#pragma once

#include <vector>

#include "compiler/model.h"
#include "compiler/scope.h"
#include "diagnostics/report.h"

namespace nplc::seqc {

/// Reports unused set-points, steps that take nonexistent ones, and more than a gateway can store with a
/// table.
void check_set_points(const Plan& plan, const std::vector<DeclaredSetPoint>& points, const Symbols& symbols,
                      Report& report);

}  // namespace nplc::seqc
