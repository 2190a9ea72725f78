#pragma once

#include <fmt/format.h>

#include <string>

namespace nplc::sim {

/// "a, b or c". Of one thing at the least.
std::string listed(const auto& things) {
    return fmt::format("{}{}{}", fmt::join(things.begin(), things.end() - 1, ", "),
                       things.size() > 1 ? " or " : "", things.back());
}

}  // namespace nplc::sim
