#include "hal_linux/quiet_thread.h"

#include <pthread.h>
#include <sched.h>

#include <csignal>
#include <utility>

namespace nplc::hal_linux {

std::thread start_quiet_thread(std::function<void()> work) {
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread thread([work = std::move(work)] {
        const sched_param none{};
        ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &none);
        work();
    });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return thread;
}

}  // namespace nplc::hal_linux
