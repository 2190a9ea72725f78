#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "protocol/midi_can.h"
#include "sim/text.h"

namespace nplc::sim {

/// A CAN bus in virtual time: one frame at a time, the lowest identifier first, at its bit rate. R: without
/// the stuffed bits, whose number depends on the data.
class CanBus {
  public:
    using Frame = protocol::midi_can::Frame;
    struct Heard {
        Frame frame;
        int sender;  ///< who gave it to send()
    };
    explicit CanBus(std::uint32_t bits_per_second) : bit_rate_(bits_per_second) {}

    /// Waits until the bus is free and nobody has a lower identifier. A sender's frames keep their order.
    void send(const Frame& frame, int sender);
    /// The frame whose transmission has ended by `now`, for everyone but its sender.
    std::optional<Heard> take(Time now);
    std::optional<Time> next_event() const;
    bool is_idle() const { return waiting_.empty() && !under_way_; }

  private:
    void start(Time now);

    std::uint32_t bit_rate_;
    std::deque<Heard> waiting_;
    std::optional<Heard> under_way_;
    Time ends_{0};
};

}  // namespace nplc::sim
