#pragma once

#include <string>

#include "analysis/verify.h"

namespace nplc::seqc::cli {

/// Verdicts as JUnit XML: one test per property and check. A broken fault is a failure, an undecided one an
/// error; advice passes and is included in the output.
std::string junit_of(const verify::Report& report, const std::string& file, const verify::Names& names);

}  // namespace nplc::seqc::cli
