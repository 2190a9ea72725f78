#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "syntax/token.h"

namespace nplc::seqc::layout {

/// The text of a program anew. Whether it is one is not looked into: any tokens are laid out somehow.
std::string lay_out(std::string_view source, const std::vector<Token>& tokens,
                    const std::vector<Token>& comments);

}  // namespace nplc::seqc::layout
