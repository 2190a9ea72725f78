#pragma once

#include <string_view>

namespace nplc::arguments {

/// The commit that the program was built from, with "-changed" behind it if the tree was not as committed;
/// "unknown" without git.
std::string_view commit();

}  // namespace nplc::arguments
