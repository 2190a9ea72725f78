#pragma once

#include <cstdint>
#include <deque>
#include <optional>
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
    /// Lets the devices send their next character, if the line is free, and takes what has arrived at the
    /// client. `next` answers a device's character, if it has one. Devices that send at once, as to an
    /// address for all, disturb each other: on the wires a 0 wins over a 1.
    template <class Devices, class Next>
    void transmit(Devices& devices, const Next& next, Time now) {
        std::optional<std::uint8_t> together;
        if (from_device.free(now)) {
            for (auto& device : devices) {
                const std::optional<std::uint8_t> byte = next(device);
                if (byte) together = static_cast<std::uint8_t>(together.value_or(0xFF) & *byte);
            }
        }
        if (together) from_device.start(*together, now);
        collect(now);
    }
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
