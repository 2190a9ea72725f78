#pragma once

#include <string>
#include <vector>

namespace nplc::hal_linux {

/// What makes Linux punctual. None of it is needed to work.
struct RealTime {
    int priority = 0;          ///< 1..99: SCHED_FIFO; 0: as other programs
    bool lock_memory = false;  ///< no page of this program ever leaves the memory
    std::vector<int> cpus{};   ///< runs on these only; none: on any
};

/// For the calling thread and those it makes. What could not be had: a line each, with what to do.
std::vector<std::string> set_up_real_time(const RealTime& wanted);

}  // namespace nplc::hal_linux
