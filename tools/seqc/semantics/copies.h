#pragma once

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// What a step knows besides its number, outputs that are set, edges that are armed, a time that runs, a lamp
/// that is dark, becomes steps of the table: a copy of the step for each combination that is reached. The one
/// reached first keeps the step's number. Changes nothing in a program without SET, R_TRIG, FOR and BLINKING.
/// Symbols of `result` get the names; reports where there is no room, or NO_HELPER stands in the way.
void make_copies(Plan& plan, Compilation& result, Report& report);

/// A timer that a program presets and tests, and that WITHIN, FOR or BLINKING of a step between have changed.
void check_shared_timer(const Plan& plan, Report& report);

}  // namespace nplc::seqc
