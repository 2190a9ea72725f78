#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "protocol/midi_can.h"
#include "protocol/midi_v24.h"
#include "sim/midi_module.h"
#include "sim/text.h"

namespace nplc::sim {

/// A module on its serial line (000 §II to §IV): receives and sends one character at a time, when the line
/// polls it.
class MidiV24End {
  public:
    explicit MidiV24End(MidiModule& module) : module_(module) {}
    /// To be called after module.advance() to the same time.
    void receive(std::uint8_t byte, bool framing_error);
    /// The next character that it has to send.
    std::optional<std::uint8_t> transmit();

  private:
    bool answers(std::uint8_t address) const;
    void serve(const protocol::midi_v24::Request& request);
    void send(std::span<const std::uint8_t> bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
    void send(std::uint8_t byte) { out_.push_back(byte); }

    MidiModule& module_;
    protocol::midi_v24::RequestDecoder decoder_;
    std::deque<std::uint8_t> out_;
};

/// A module on its CAN bus (003 §V): a frame in, frames out.
class MidiCanEnd {
  public:
    explicit MidiCanEnd(MidiModule& module) : module_(module) {}
    /// To be called after module.advance() to the same time.
    void receive(const base::CanFrame& frame);
    /// The next frame to send; to be polled often, since it also boots by itself.
    std::optional<base::CanFrame> transmit();

  private:
    void serve(const protocol::midi_can::Request& request);
    void configure(const protocol::midi_can::Request& request);
    void send(const protocol::midi_can::Answer& answer) {
        out_.push_back(protocol::midi_can::encode_answer(answer));
    }

    MidiModule& module_;
    std::deque<base::CanFrame> out_;
    bool configuring_ = false;
    std::optional<std::uint8_t> new_address_;
};

/// A CAN bus in virtual time: one frame at a time, the lowest identifier first, at its bit rate. R: without
/// the stuffed bits, whose number depends on the data.
class CanBus {
  public:
    using Frame = base::CanFrame;
    struct Heard {
        Frame frame;
        int sender;  ///< parameter of send()
    };
    explicit CanBus(std::uint32_t bits_per_second) : bit_rate_(bits_per_second) {}

    /// Queued until the bus is free and no sender has a lower identifier. A sender's frames keep their order.
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
