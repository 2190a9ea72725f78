#pragma once

#include <vector>

#include "compiler/model.h"
#include "diagnostics/report.h"
#include "sequencer/term.h"

namespace nplc::seqc {

struct LoweredTerm {
    sequencer::TermBytes bytes;
    Span span;
};

/// The terms of one step. `outputs_of` holds the outputs of every step by number.
///
/// A term tests ten bits; timer and counter only for zero, ERROR always. A rule that requires "not yet zero"
/// becomes a term without that test which a later one overrides: next step and outputs can be overridden (the
/// last true term decides), commands and presets cannot, so such a rule is an error (001 §6.1.5, §6.1.9).
std::vector<LoweredTerm> lower(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                               Report& report);

}  // namespace nplc::seqc
