#pragma once

#include <vector>

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "semantics/scope.h"

namespace nplc::seqc {

/// Set-points that nothing uses, steps that take what there is not, and more than a gateway keeps with a
/// table.
void check_set_points(const Plan& plan, const std::vector<DeclaredSetPoint>& points, const Symbols& symbols,
                      Report& report);

}  // namespace nplc::seqc
