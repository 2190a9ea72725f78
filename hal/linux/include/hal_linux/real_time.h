#pragma once

#include <string>
#include <vector>

namespace nplc::hal_linux {

/// Real-time options of Linux. All are optional.
struct RealTime {
    int priority = 0;          ///< 1..99: SCHED_FIFO; 0: ordinary priority
    bool lock_memory = false;  ///< no page of this program is swapped out
    std::vector<int> cpus{};   ///< runs on these only; empty: on any
};

/// For the calling thread and the threads it creates. Returns one line per failed option, with the remedy.
std::vector<std::string> set_up_real_time(const RealTime& wanted);

}  // namespace nplc::hal_linux
