#pragma once

#include "diagnostics/report.h"
#include "registers/family.h"
#include "semantics/model.h"

namespace nplc::seqc {

/// TERM lines that a gateway refuses, or that stand behind the table's end. `drive`: whose registers they
/// are, or null.
void check_raw_terms(const Plan& plan, const registers::DriveModel* drive, Report& report);

}  // namespace nplc::seqc
