#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"

namespace nplc::hal_linux {

/// Waits for events: a readable descriptor, a signal, or a deadline. Uses no thread, and never wakes without
/// an event.
class EventLoop {
  public:
    struct Opened {
        std::unique_ptr<EventLoop> loop;
        std::string error;  ///< one line, if there is no loop
    };
    /// From now on `signals` do not end the program; signal() returns them.
    static Opened open(std::span<const int> signals);
    ~EventLoop();
    EventLoop(const EventLoop&) = delete;
    EventLoop& operator=(const EventLoop&) = delete;

    enum class Wakes : std::uint8_t {
        while_readable,
        at_news,  ///< once per event; for descriptors that report a hang-up as long as there is no client
    };
    /// `mark`: returned by `wait` for this descriptor. A descriptor that is already watched gets the new
    /// mark. A closed descriptor is removed automatically.
    bool watch(int descriptor, std::uint32_t mark, Wakes wakes = Wakes::while_readable);

    void ignore(int descriptor);

    /// Sleeps until an event, or until `deadline` at the latest (kNever: no limit; in the past: returns at
    /// once). Returns the marks of the readable descriptors; may be empty.
    std::span<const std::uint32_t> wait(base::Instant deadline);

    /// The oldest pending signal.
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
