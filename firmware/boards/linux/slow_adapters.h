#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config.h"
#include "hal_linux/latency.h"

namespace nplc::boards {

/// The motors' lines on this machine whose USB adapters hold characters back for longer than 1 ms, also after
/// `ask` as the service does it.
std::vector<Mistake> slow_adapters(
    const Config& config, const std::string& sysfs = "/sys",
    const std::function<void(const std::string& path)>& ask = [](const std::string& path) {
        hal_linux::ask_for_low_latency(path);
    });

}  // namespace nplc::boards
