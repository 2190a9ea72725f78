#pragma once

#include "analysis/verify.h"
#include "seqc/seqc.h"

/// Converts a program to the input of tools/sequence/analysis.
namespace nplc::seqc {

verify::Names verify_names(const Symbols& symbols);
/// For a table without symbols: steps and signals by number, registers by the manual's names.
verify::Names verify_names();

/// The times of `seqc report`. `translated`: for a drive whose orders the gateway translates; their time is
/// known only as the gateway's longest wait.
verify::OrderTime order_times(bool translated);

std::vector<verify::Allowance> allowances_in(const Compilation& program);

}  // namespace nplc::seqc
