#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "protocol/midi_can.h"
#include "sim/midi_module.h"

namespace nplc::sim {

/// A module on its CAN bus (003 §V): a frame in, frames out.
class MidiCanEnd {
  public:
    explicit MidiCanEnd(MidiModule& module) : module_(module) {}
    /// To be called after module.advance() to the same time.
    void receive(const protocol::midi_can::Frame& frame);
    /// The next frame that it has to send; asked for often, for it also boots by itself.
    std::optional<protocol::midi_can::Frame> transmit();

  private:
    void serve(const protocol::midi_can::Request& request);
    void configure(const protocol::midi_can::Request& request);
    void send(const protocol::midi_can::Answer& answer) {
        out_.push_back(protocol::midi_can::encode_answer(answer));
    }

    MidiModule& module_;
    std::deque<protocol::midi_can::Frame> out_;
    bool configuring_ = false;
    std::optional<std::uint8_t> new_address_;
};

}  // namespace nplc::sim
