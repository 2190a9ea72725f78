#include "hal_linux/steady_clock.h"

#include <chrono>

#include "host/clock.h"

namespace nplc::host {

base::Instant steady_now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return base::Instant(std::chrono::duration_cast<base::Microseconds>(since));
}

}  // namespace nplc::host

namespace nplc::hal_linux {

base::Instant SteadyClock::now() {
    return host::steady_now();
}

std::uint64_t calendar_milliseconds() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
}

}  // namespace nplc::hal_linux
