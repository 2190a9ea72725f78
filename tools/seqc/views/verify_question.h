#pragma once

#include <string_view>

#include "seqc/seqc.h"
#include "verify/verify.h"

/// Converts a program to the input of tools/verify.
namespace nplc::seqc {

verify::Names verify_names(const Symbols& symbols);
/// For a table without symbols: steps and signals by number, registers by the manual's names.
verify::Names verify_names();

/// The times of `seqc report`. `translated`: for a drive whose orders the gateway translates; their time is
/// known only as the gateway's longest wait.
verify::OrderTime order_times(bool translated);

/// The properties of a program, with their lines.
verify::PropertyReading properties_in(const Compilation& program, std::string_view source,
                                      const verify::Names& names);

std::vector<verify::Allowance> allowances_in(const Compilation& program);

}  // namespace nplc::seqc
