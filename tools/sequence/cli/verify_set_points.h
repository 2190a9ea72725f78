#pragma once

#include <span>
#include <vector>

#include "analysis/verify.h"
#include "set_points/record.h"

namespace nplc::seqc::cli {

/// Verifies a table for all values of its set-points: what is proved holds for each of them, what is broken
/// names the values. Registers of the motor do not affect courses; times and counts are free in the explorer,
/// and if that leaves a verdict undecided their range limits and single counts are tried.
verify::Report verify_all_values(std::span<const std::uint8_t> table, const set_points::Record& record,
                                 const verify::Names& names, const std::vector<verify::Property>& properties,
                                 const verify::Options& how);

}  // namespace nplc::seqc::cli
