#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "syntax/token.h"

namespace nplc::seqc::layout {

/// The text of a program anew. Whether it is one is not looked into: any tokens are laid out somehow.
std::string lay_out(std::string_view source, std::vector<Token> tokens, std::vector<Token> comments);

/// Why `text` cannot stand for `source`: a word or a comment differs, or formatting it again would change it.
/// Empty if it can.
std::string fault_between(std::string_view source, std::string_view text);

}  // namespace nplc::seqc::layout
