#pragma once

#include <string_view>
#include <vector>

#include "language/ast.h"

namespace nplc::seqc {

/// The alternatives at a place, collected while the parser tries them.
struct Expected {
    std::vector<std::string_view> words;
    std::vector<ast::Role> names;
    bool value = false;
    bool unit = false;
};

/// The token that marks such a place; it matches nothing else.
inline constexpr std::string_view kPlace = "";

}  // namespace nplc::seqc
