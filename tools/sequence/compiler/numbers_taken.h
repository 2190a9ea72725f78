#pragma once

#include <vector>

#include "compiler/copy_names.h"
#include "compiler/model.h"
#include "compiler/sequence_calls.h"
#include "diagnostics/report.h"

namespace nplc::seqc {

/// Notes to a lack of numbers: how many the calls of each SEQUENCE take, and those steps that take most.
void note_numbers_taken(const std::vector<CopyKey>& copies, const Plan& plan, const SequenceCalls& calls,
                        Diagnostic& diagnostic);

}  // namespace nplc::seqc
