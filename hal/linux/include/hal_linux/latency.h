#pragma once

#include <optional>
#include <string>

#include "base/time.h"

namespace nplc::hal_linux {

/// The USB adapter of a serial line.
struct Adapter {
    std::string timer_file;      ///< /sys/bus/usb-serial/devices/ttyUSB0/latency_timer
    base::Milliseconds latency;  ///< for which it holds received characters back
};

/// Empty: `path` is no USB adapter with such a timer. `sysfs`: another root, for tests.
std::optional<Adapter> find_adapter(const std::string& path, const std::string& sysfs = "/sys");

/// Asks the driver of an open serial line for the shortest latency; not supported by every one.
void ask_for_low_latency(int descriptor);
/// The same on a line that is opened for it.
void ask_for_low_latency(const std::string& path);

}  // namespace nplc::hal_linux
