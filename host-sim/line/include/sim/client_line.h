#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/serial_line.h"

namespace nplc::sim {

/// The line between an outside client, which sends any number of bytes at once, and virtual devices, which
/// send and receive one character at a time.
class ClientLine {
  public:
    explicit ClientLine(std::uint32_t baud) : to_device(baud, 1), from_device(baud, 1) {}

    /// Queued until the line is free; beyond 64 KiB bytes are lost.
    void send(std::span<const std::uint8_t> bytes);
    /// Starts the next queued character if the line is free.
    void start(Time now);
    /// Lets the devices send their next character if the line is free, and receives at the client. `next`
    /// returns a device's character, if it has one. Devices that send at the same time, as on a broadcast
    /// address, disturb each other: on the wires a 0 overrides a 1.
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
    /// Receives at the client.
    void collect(Time now);
    /// The bytes received since the last call.
    std::vector<std::uint8_t> received() { return std::exchange(received_, {}); }
    Time next_event(Time limit) const;
    /// Sets both ends. Characters in transit are lost: needs is_quiet().
    void set_baud(std::uint32_t baud);
    /// No character is in transit.
    bool is_quiet(Time now) const;

    LineDirection to_device;
    LineDirection from_device;

  private:
    std::deque<std::uint8_t> waiting_;
    std::vector<std::uint8_t> received_;
};

}  // namespace nplc::sim
