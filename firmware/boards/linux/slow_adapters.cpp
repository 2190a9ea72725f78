#include "slow_adapters.h"

#include <fmt/format.h>

namespace nplc::boards {

std::vector<Mistake> slow_adapters(const Config& config, const std::string& sysfs,
                                   const std::function<void(const std::string& path)>& ask) {
    constexpr base::Milliseconds kShortest{1};
    std::vector<Mistake> slow;
    for (const AxisConfig& axis : config.axes) {
        const LocatedText& port = axis.motor.port;
        if (!port.is_there() || is_endpoint(port.text)) continue;
        auto adapter = hal_linux::find_adapter(port.text, sysfs);
        if (!adapter || adapter->latency <= kShortest) continue;
        ask(port.text);
        adapter = hal_linux::find_adapter(port.text, sysfs);
        if (!adapter || adapter->latency <= kShortest) continue;
        slow.push_back({port.line, port.key,
                        fmt::format("the USB adapter {} holds characters back for {} ms: each order takes "
                                    "that much longer, and a cut is noticed later; for 1 ms install the "
                                    "package's udev rule (/lib/udev/rules.d/70-nanoplc.rules) and plug the "
                                    "adapter in anew, or write 1 to {}; if its driver refuses that, use "
                                    "another adapter",
                                    port.text, adapter->latency.count(), adapter->timer_file)});
    }
    return slow;
}

}  // namespace nplc::boards
