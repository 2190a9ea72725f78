#pragma once

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// What a program most likely forgot although each of its lines is right: a timer that is never set, a step
/// without exit, an error that is never reset.
void check_oversights(const Plan& plan, const Symbols& symbols, Report& report);

}  // namespace nplc::seqc
