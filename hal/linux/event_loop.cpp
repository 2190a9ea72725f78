#include "hal_linux/event_loop.h"

#include <sys/epoll.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace nplc::hal_linux {
namespace {

constexpr std::size_t kAtOnce = 32;
constexpr std::uint64_t kTimer = std::uint64_t{1} << 32;  // not one of the caller's marks
constexpr std::uint64_t kSignals = kTimer + 1;

timespec in_timespec(base::Microseconds time) {
    constexpr std::int64_t kSecond = 1'000'000;
    // Both members have 32 bits on 32-bit Arm.
    return {.tv_sec = static_cast<decltype(timespec::tv_sec)>(time.count() / kSecond),
            .tv_nsec = static_cast<decltype(timespec::tv_nsec)>(time.count() % kSecond * 1000)};
}

}  // namespace

EventLoop::Opened EventLoop::open(std::span<const int> signals) {
    std::unique_ptr<EventLoop> loop(new EventLoop);
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : signals) sigaddset(&set, signal);
    loop->epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
    loop->timer_ = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    const bool blocked = ::sigprocmask(SIG_BLOCK, &set, nullptr) == 0;
    loop->signals_ = ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
    const bool had = loop->epoll_ >= 0 && loop->timer_ >= 0 && blocked && loop->signals_ >= 0;
    if (!had || !loop->add(loop->timer_, kTimer, EPOLLIN) || !loop->add(loop->signals_, kSignals, EPOLLIN))
        return {nullptr, std::string("the event loop cannot be made: ") + std::strerror(errno)};
    return {std::move(loop), {}};
}

EventLoop::~EventLoop() {
    for (const int descriptor : {epoll_, timer_, signals_}) {
        if (descriptor >= 0) ::close(descriptor);
    }
}

bool EventLoop::add(int descriptor, std::uint64_t mark, std::uint32_t events) {
    epoll_event event{.events = events, .data = {.u64 = mark}};
    if (::epoll_ctl(epoll_, EPOLL_CTL_ADD, descriptor, &event) == 0) return true;
    return errno == EEXIST && ::epoll_ctl(epoll_, EPOLL_CTL_MOD, descriptor, &event) == 0;
}

bool EventLoop::watch(int descriptor, std::uint32_t mark, Wakes wakes) {
    const bool at_news = wakes == Wakes::at_news;
    return add(descriptor, mark, EPOLLIN | (at_news ? std::uint32_t{EPOLLET} : 0U));
}

void EventLoop::ignore(int descriptor) {
    ::epoll_ctl(epoll_, EPOLL_CTL_DEL, descriptor, nullptr);
}

void EventLoop::set_alarm(base::Instant deadline) {
    if (alarm_ == deadline) return;
    alarm_ = deadline;
    itimerspec time{};  // zero: no alarm
    if (deadline != base::kNever) time.it_value = in_timespec(deadline.time_since_epoch());
    if (deadline != base::kNever && time.it_value.tv_sec == 0 && time.it_value.tv_nsec == 0)
        time.it_value.tv_nsec = 1;
    ::timerfd_settime(timer_, TFD_TIMER_ABSTIME, &time, nullptr);
}

std::span<const std::uint32_t> EventLoop::wait(base::Instant deadline) {
    set_alarm(deadline);
    std::array<epoll_event, kAtOnce> events{};
    const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), -1);
    marks_.clear();
    for (int i = 0; i < count; ++i) {
        const std::uint64_t mark = events[static_cast<std::size_t>(i)].data.u64;
        if (mark == kTimer) alarm_.reset();  // acknowledged by setting the next alarm
        if (mark < kTimer) marks_.push_back(static_cast<std::uint32_t>(mark));
    }
    return marks_;
}

std::optional<int> EventLoop::signal() {
    signalfd_siginfo info{};
    if (::read(signals_, &info, sizeof info) != sizeof info) return std::nullopt;
    return static_cast<int>(info.ssi_signo);
}

}  // namespace nplc::hal_linux
