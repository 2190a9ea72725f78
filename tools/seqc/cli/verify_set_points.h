#pragma once

#include <span>
#include <vector>

#include "set_points/record.h"
#include "verify/verify.h"

namespace nplc::seqc::cli {

/// Verifies a table with the values of its set-points free in their ranges: what is proved holds for each of
/// them, what is broken says with which. Registers of the motor make no difference to courses; times and
/// counts are free within the explorer, and where that leaves a verdict open their ends and single counts are
/// tried.
verify::Report verify_all_values(std::span<const std::uint8_t> table, const set_points::Record& record,
                                 const verify::Names& names, const std::vector<verify::Property>& properties,
                                 const verify::Options& how);

}  // namespace nplc::seqc::cli
