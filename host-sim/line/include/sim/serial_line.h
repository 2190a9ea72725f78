#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "ports/serial.h"
#include "sim/text.h"

namespace nplc::sim {

/// Faults of one direction; each share is 0..1 of all characters.
struct LineFaults {
    double drop = 0;
    double damage = 0;   ///< one data bit flipped in 3 of 4 cases, any mixture of bits otherwise
    double framing = 0;  ///< arrives with a framing error and some other value
    double delay = 0;
    Time longest_delay = std::chrono::milliseconds{5};  ///< longest delay of a delayed character
    Time late{0};                                       ///< constant delay of every character
    Time together{0};  ///< characters are held back until the next multiple of this time, as by a USB adapter
    bool operator==(const LineFaults&) const = default;
};

struct LineCounters {
    std::uint64_t sent = 0;
    std::uint64_t delivered = 0;
    std::uint64_t dropped = 0;
    std::uint64_t damaged = 0;
    std::uint64_t damaged_alike =
        0;  ///< changed by the same bits as the character before: no repeat shows it
    std::uint64_t framing = 0;
    std::uint64_t delayed = 0;
    std::uint64_t cut = 0;  ///< lost because the line was cut
};

/// One direction of an asynchronous line, 10 bits a character (8N1). A character arrives when its stop bit
/// ends; characters never overtake each other, so those behind a delayed one wait for it and then arrive
/// together.
class LineDirection {
  public:
    LineDirection(std::uint32_t baud, std::uint64_t seed);

    bool free(Time now) const { return now >= busy_until_; }
    Time busy_until() const { return busy_until_; }

    /// Needs free(now). Back-to-back characters keep the exact rate.
    void start(std::uint8_t byte, Time now);

    std::optional<Time> next_arrival() const {
        return flying_.empty() ? std::nullopt : std::optional<Time>(flying_.front().arrival);
    }
    /// The oldest character received by `now`.
    std::optional<ports::ReceivedByte> take(Time now);

    void set_faults(const LineFaults& faults);
    const LineFaults& faults() const { return faults_; }
    void reseed(std::uint64_t seed);
    /// With different rates every character arrives changed and with a framing error.
    void set_rates(std::uint32_t sender, std::uint32_t receiver);
    /// While cut, sent characters do not arrive; those in transit are lost too.
    void cut();
    void restore() { cut_ = false; }
    bool is_cut() const { return cut_; }
    const LineCounters& counters() const { return counters_; }

  private:
    struct Flying {
        ports::ReceivedByte byte;
        Time arrival;
    };

    struct Luck {
        double drop, damage, framing, delay, wait;
        std::uint8_t mask;
    };

    void clock_out(Time now);
    Luck draw_all();
    double draw();
    std::uint8_t damage_mask();

    std::uint32_t baud_;
    bool rates_differ_ = false;
    std::uint64_t remainder_ = 0;
    Time busy_until_{0};
    Time last_arrival_{0};
    bool cut_ = false;
    LineFaults faults_;
    bool has_faults_ = false;
    std::uint8_t last_mask_ = 0;  ///< damage of the previous character
    LineCounters counters_;
    std::mt19937_64 random_;
    std::uint64_t undrawn_ = 0;  ///< good characters whose random draws are still to be skipped
    std::deque<Flying> flying_;
};

/// A line between the gateway, which has a buffered serial port, and the motor, whose characters the
/// simulation polls and delivers one at a time.
class VirtualSerialLine {
  public:
    VirtualSerialLine(std::uint32_t baud, std::uint64_t seed);

    ports::SerialPort& port() { return port_; }
    LineDirection& to_motor() { return to_motor_; }
    LineDirection& from_motor() { return from_motor_; }
    const LineDirection& to_motor() const { return to_motor_; }
    const LineDirection& from_motor() const { return from_motor_; }

    void set_rates(std::uint32_t gateway, std::uint32_t other_end);

    /// Sends the gateway's queued characters and fills its receive buffer. True if something was received.
    bool service(Time now);

    /// The gateway has unsent characters.
    bool has_waiting() const { return !port_.waiting.empty(); }

    /// Both directions.
    void cut();
    void restore();
    void reseed(std::uint64_t seed);
    bool is_cut() const { return to_motor_.is_cut(); }
    std::uint64_t overruns() const { return port_.overruns; }

  private:
    struct Port final : ports::SerialPort {
        static constexpr std::size_t kTransmitRoom = 64;
        static constexpr std::size_t kReceiveRoom = 256;

        std::size_t write(std::span<const std::uint8_t> bytes) override;
        std::size_t read(std::span<ports::ReceivedByte> out) override;
        bool transmitter_idle() override { return waiting.empty() && wire_free; }

        std::deque<std::uint8_t> waiting;
        std::deque<ports::ReceivedByte> received;
        bool wire_free = true;
        std::uint64_t overruns = 0;
    };

    Port port_;
    LineDirection to_motor_;
    LineDirection from_motor_;
};

}  // namespace nplc::sim
