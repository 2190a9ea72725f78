#pragma once

#include <string>
#include <vector>

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A term cannot test that timer or counter are still running (001 §6.1.5). A branch that needs that for a
/// command, a register value or a preset, which no later term can cancel, becomes a transition to a helper
/// step, which acts in the next scan. Reports E071 or E072 if that is not possible.
void make_helper_steps(Plan& plan, Compilation& result, Report& report);

/// `name`, shortened and numbered until it is unique among the steps.
std::string free_step_name(const std::vector<StepPlan>& steps, std::string name);

}  // namespace nplc::seqc
