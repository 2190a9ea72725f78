#pragma once

#include <optional>

#include "hal_linux/steady_clock.h"

namespace nplc::hal_linux {

inline base::Instant present() {
    return SteadyClock().now();
}

/// A quarter of the watchdog timeout has passed since the last feed.
inline bool is_due(std::optional<base::Instant> fed, base::Instant now, base::Microseconds timeout) {
    return !fed || now - *fed >= timeout / 4;
}

}  // namespace nplc::hal_linux
