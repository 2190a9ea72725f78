#pragma once

#include <string>
#include <vector>

#include "diagnostics/report.h"
#include "semantics/model.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A term cannot test that timer or counter still run (001 §6.1.5). A branch that needs that for a command, a
/// register value or a preset, which no later term can take back, becomes a switch to a helper step, which
/// does it in the scan after. Reports E071 or E072 where none can be made.
void make_helper_steps(Plan& plan, Compilation& result, Report& report);

/// `name`, shortened and numbered until no step has it.
std::string free_step_name(const std::vector<StepPlan>& steps, std::string name);

}  // namespace nplc::seqc
