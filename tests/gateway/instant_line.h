#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ports/serial.h"

namespace nplc::gateway {

/// A line without time: what one end writes the other reads at its next poll.
struct InstantLine final : ports::SerialPort {
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        const std::size_t count = std::min(bytes.size(), room);
        sent.insert(sent.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        for (; count < out.size() && !received.empty(); ++count) {
            out[count] = received.front();
            received.pop_front();
        }
        return count;
    }
    bool transmitter_idle() override { return true; }
    ports::LineFaults faults() const override { return counted; }

    std::size_t room = static_cast<std::size_t>(-1);  ///< for a write
    ports::LineFaults counted;
    std::vector<std::uint8_t> sent;
    std::deque<ports::ReceivedByte> received;
};

}  // namespace nplc::gateway
