#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"

namespace nplc::hal_linux {

/// One place to sleep until something happens: a descriptor is readable, a signal came, or it is time. No
/// thread, and no wake-up without a cause.
class EventLoop {
  public:
    struct Opened {
        std::unique_ptr<EventLoop> loop;
        std::string error;  ///< one line, without a loop
    };
    /// `signals` are kept from killing the program from now on; `signal` tells of them.
    static Opened open(std::span<const int> signals);
    ~EventLoop();
    EventLoop(const EventLoop&) = delete;
    EventLoop& operator=(const EventLoop&) = delete;

    enum class Wakes : std::uint8_t {
        while_readable,
        at_news,  ///< once for what came; for descriptors that report a hang-up as long as nobody is there
    };
    /// `mark`: what `wait` answers for it. One that is watched already gets the new mark. A descriptor that
    /// is closed is forgotten by itself.
    bool watch(int descriptor, std::uint32_t mark, Wakes wakes = Wakes::while_readable);

    void ignore(int descriptor);

    /// Sleeps until there is something, or until `deadline` at the latest (kNever: no end; one that is past:
    /// only looks). Answers the marks of what is readable, which may be none.
    std::span<const std::uint32_t> wait(base::Instant deadline);

    /// The oldest signal that has not been taken.
    std::optional<int> signal();

  private:
    EventLoop() = default;
    bool add(int descriptor, std::uint64_t mark, std::uint32_t events);
    void set_alarm(base::Instant deadline);

    int epoll_ = -1;
    int timer_ = -1;
    int signals_ = -1;
    std::optional<base::Instant> alarm_;
    std::vector<std::uint32_t> marks_;
};

}  // namespace nplc::hal_linux
