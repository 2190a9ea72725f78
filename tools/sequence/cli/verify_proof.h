#pragma once

#include <string>

#include "analysis/verify.h"
#include "cli/input.h"

namespace nplc::seqc::cli {

/// `verify --proof`. If not everything is proved it prints a note on standard error and leaves the file
/// unchanged.
int write_certificate(const std::string& file, const verify::Report& report, bool all_proved,
                      const Input& input, const std::string& assume, const std::string& assumption);

}  // namespace nplc::seqc::cli
