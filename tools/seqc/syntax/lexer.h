#pragma once

#include <string_view>
#include <vector>

#include "syntax/report.h"
#include "syntax/token.h"

namespace nplc::seqc {

/// The tokens of `source`, an end token last. They point into `source`.
std::vector<Token> tokens_of(std::string_view source, Report& report);

}  // namespace nplc::seqc
