#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "sim/serial_line.h"

namespace nplc::sim {

/// The line between an outside client, whose bytes come in any amount, and virtual devices, which take and
/// give a character at a time.
class ClientLine {
  public:
    explicit ClientLine(std::uint32_t baud) : to_device(baud, 1), from_device(baud, 1) {}

    /// Waits for the line to be free; beyond 64 KiB it is lost.
    void send(std::span<const std::uint8_t> bytes);
    /// Lets the next waiting character begin, if the line is free.
    void start(Time now);
    /// Takes what has arrived at the client.
    void collect(Time now);
    /// All that has arrived since the last call.
    std::vector<std::uint8_t> received() { return std::exchange(received_, {}); }
    Time next_event(Time limit) const;
    /// Both ends from now on. What is on the way is lost: needs is_quiet().
    void set_baud(std::uint32_t baud);
    /// No character is on the way.
    bool is_quiet(Time now) const;

    LineDirection to_device;
    LineDirection from_device;

  private:
    std::deque<std::uint8_t> waiting_;
    std::vector<std::uint8_t> received_;
};

}  // namespace nplc::sim
