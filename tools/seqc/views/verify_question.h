#pragma once

#include <string_view>

#include "seqc/seqc.h"
#include "verify/verify.h"

/// A program as a question for tools/verify.
namespace nplc::seqc {

verify::Names verify_names(const Symbols& symbols);
/// Of a table without symbols: steps and signals by number, registers by the manual's names.
verify::Names verify_names();

/// As `seqc report` works it out. `translated`: of a drive whose orders the gateway translates; what it takes
/// is known only as the longest that a gateway waits.
verify::OrderTime order_times(bool translated);

/// The properties of a program, at their lines.
verify::PropertyReading properties_in(const Compilation& program, std::string_view source,
                                      const verify::Names& names);

std::vector<verify::Allowance> allowances_in(const Compilation& program);

}  // namespace nplc::seqc
