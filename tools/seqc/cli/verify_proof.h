#pragma once

#include <string>

#include "cli/input.h"
#include "verify/verify.h"

namespace nplc::seqc::cli {

/// `verify --proof`. If not all is proved a note on standard error, and the file stays as it was.
int write_certificate(const std::string& file, const verify::Report& report, bool all_proved,
                      const Input& input, const std::string& assume, const std::string& assumption);

}  // namespace nplc::seqc::cli
