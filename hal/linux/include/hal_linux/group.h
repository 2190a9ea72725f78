#pragma once

#include <optional>
#include <string>

namespace nplc::hal_linux {

/// The number of a group of /etc/group.
std::optional<unsigned> group_number(const std::string& name);

}  // namespace nplc::hal_linux
