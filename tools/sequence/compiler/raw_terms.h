#pragma once

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "registers/family.h"

namespace nplc::seqc {

/// Reports TERM lines that a gateway refuses, or that are behind the table's end. `drive`: the drive with
/// these registers, or null.
void check_raw_terms(const Plan& plan, const registers::DriveModel* drive, Report& report);

}  // namespace nplc::seqc
