#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "protocol/midi_v24.h"
#include "sim/midi_module.h"

namespace nplc::sim {

/// A module on its serial line (000 §II to §IV): a character in, characters out when the line asks for them.
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

}  // namespace nplc::sim
