#pragma once

#include <cstdlib>

/// What a target holds: input that breaks it ends in abort().
inline void require(bool holds) {
    if (!holds) std::abort();
}
