// What a client's reads of the motor cost a running sequence, in virtual time: always the same figures.
#include <algorithm>
#include <cstdio>

#include "port_traffic.h"

int main() {
    using namespace nplc;
    using Traffic = property::PortTraffic::Traffic;
    sim::Time worst{0};
    sim::Time worst_executed{0};
    base::Microseconds scan_alone{0};
    base::Microseconds scan_beside{0};
    std::uint32_t reads = 0;
    constexpr std::uint64_t kRuns = 20;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        property::PortTraffic alone(seed, Traffic::none);
        alone.run();
        property::PortTraffic beside(seed, Traffic::reads);
        beside.run();
        for (std::size_t i = 0; i < alone.ordered().size(); ++i)
            worst = std::max(worst, beside.ordered()[i].at - alone.ordered()[i].at);
        const auto without = alone.executed();
        const auto with = beside.executed();
        for (std::size_t i = 0; i < without.size(); ++i)
            worst_executed = std::max(worst_executed, with[i] - without[i]);
        scan_alone = std::max(scan_alone, alone.world().gateway().worst_scan_time());
        scan_beside = std::max(scan_beside, beside.world().gateway().worst_scan_time());
        reads += beside.world().driver().counters().accesses;
    }
    std::printf("%u reads beside %u sequences of 10.6 s, 19200 baud\n", reads, static_cast<unsigned>(kRuns));
    std::printf("worst added delay of an order until the scan gives it: %.2f ms\n",
                static_cast<double>(worst.count()) / 1e6);
    std::printf("worst time from one scan to the next, orders and all: %.2f ms; without reads %.2f ms\n",
                static_cast<double>(scan_beside.count()) / 1e3,
                static_cast<double>(scan_alone.count()) / 1e3);
    std::printf("worst added delay until the motor executes it: %.2f ms\n",
                static_cast<double>(worst_executed.count()) / 1e6);
    return 0;
}
