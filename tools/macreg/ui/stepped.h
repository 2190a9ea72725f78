#pragma once

#include <algorithm>
#include <cstddef>

namespace nplc::macreg {

/// An index into `size` things after some steps, which end at the first and the last one.
inline std::size_t stepped(std::size_t at, int steps, std::size_t size) {
    if (size == 0) return 0;
    const auto wanted = static_cast<std::ptrdiff_t>(at) + steps;
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(wanted, 0, static_cast<std::ptrdiff_t>(size) - 1));
}

}  // namespace nplc::macreg
