#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "base/time.h"
#include "ports/serial.h"

namespace nplc::motor {

using Bytes = std::vector<std::uint8_t>;

/// A line whose other end is the test: it records what is sent, and determines what is received.
class ScriptedLine final : public ports::SerialPort {
  public:
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        sent.insert(sent.end(), bytes.begin(), bytes.end());
        in_transmitter += bytes.size();
        return bytes.size();
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        while (count < out.size() && !received.empty()) {
            out[count++] = received.front();
            received.pop_front();
        }
        return count;
    }
    bool transmitter_idle() override { return in_transmitter == 0; }

    Bytes take() { return std::exchange(sent, {}); }

    Bytes sent;
    std::deque<ports::ReceivedByte> received;
    std::size_t in_transmitter = 0;
};

/// Runs something with `poll(now)` on a ScriptedLine, one character time (19200 baud, 8N1) a step.
template <class Polled>
class Script {
  public:
    static constexpr base::Microseconds kCharacter{521};

    Script(ScriptedLine& line, Polled& polled) : line_(line), polled_(polled) {}

    /// One character time in which the motor sends `byte`. Answers poll's result if it has one.
    auto hear(std::uint8_t byte, bool framing_error = false) {
        line_.received.push_back({byte, framing_error});
        return silence();
    }
    auto silence() {
        now += kCharacter;
        if (line_.in_transmitter != 0) --line_.in_transmitter;
        return polled_.poll(now);
    }
    void hear_times(int times, std::uint8_t byte) {
        for (int i = 0; i < times; ++i) static_cast<void>((hear(byte), 0));
    }

    base::Instant now{base::Milliseconds(1000)};

  private:
    ScriptedLine& line_;
    Polled& polled_;
};

}  // namespace nplc::motor
