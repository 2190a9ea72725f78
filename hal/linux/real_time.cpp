#include "hal_linux/real_time.h"

#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>

#include "reason.h"

namespace nplc::hal_linux {
namespace {

std::string in_words(const std::vector<int>& cpus) {
    std::string text;
    for (const int cpu : cpus) text += (text.empty() ? "" : ", ") + std::to_string(cpu);
    return text;
}

bool bind_to(const std::vector<int>& cpus) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : cpus) CPU_SET(static_cast<std::size_t>(cpu), &set);
    return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

}  // namespace

std::vector<std::string> set_up_real_time(const RealTime& wanted) {
    std::vector<std::string> missed;
    if (!wanted.cpus.empty() && !bind_to(wanted.cpus))
        missed.push_back("runs on any processor, not on " + in_words(wanted.cpus) + " alone: " + reason() +
                         "; `nproc --all` counts them, the first is 0");
    if (wanted.lock_memory && ::mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
        missed.push_back("its memory is not locked: " + reason() +
                         "; it needs LimitMEMLOCK=infinity in the service, or CAP_IPC_LOCK");
    const sched_param parameter{.sched_priority = wanted.priority};
    if (wanted.priority > 0 && ::sched_setscheduler(0, SCHED_FIFO, &parameter) != 0)
        missed.push_back("runs without real-time priority " + std::to_string(wanted.priority) + ": " +
                         reason() + "; it needs LimitRTPRIO=99 in the service, or CAP_SYS_NICE");
    return missed;
}

}  // namespace nplc::hal_linux
