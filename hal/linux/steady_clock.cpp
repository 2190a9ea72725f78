#include "hal_linux/steady_clock.h"

#include <chrono>

namespace nplc::hal_linux {

base::Instant SteadyClock::now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return base::Instant(std::chrono::duration_cast<base::Microseconds>(since));
}

}  // namespace nplc::hal_linux
