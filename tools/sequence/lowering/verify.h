#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/model.h"
#include "lowering/lower.h"

namespace nplc::seqc {

/// The first case (see truth.h) in which the step's terms differ from its rules: next step, outputs, presets,
/// counter and orders in their order, the last true term deciding (001 §6.1.9). The raw terms at the end of
/// `terms` are ignored. Works on the bytes only, so that it also detects errors of the lowering.
std::optional<std::size_t> first_difference(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                                            const std::vector<LoweredTerm>& terms);

/// Reports a difference as an internal error of the compiler.
void check_terms(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                 const std::vector<LoweredTerm>& terms, Report& report);

}  // namespace nplc::seqc
