#pragma once

#include <cstdint>

#include "motor/midi_link.h"
#include "ports/can.h"
#include "protocol/answer_count.h"
#include "protocol/midi_can.h"

namespace nplc::motor {

/// A MIDI module on a CAN bus (003 §V). A frame that does not fit into the port is offered again until the
/// answer timeout. A bus-off controller is restarted, once in 100 ms.
class MidiCanLink final : public MidiLink {
  public:
    struct Settings {
        std::uint8_t address = 1;  ///< 1..127
    };

    /// Sets the port's filters to the module's answers and boot-up messages, and to other masters' requests
    /// to it.
    MidiCanLink(ports::CanPort& port, const Settings& settings);

    void begin(const MidiMessage& message, base::Instant now) override;
    MidiOutcome poll(base::Instant now) override;
    base::Instant next_poll(base::Instant now) const override;
    bool busy() const override { return busy_; }
    bool take_boot() override;
    BusFault trouble() const override;
    void withdraw() override { busy_ = busy_ && written_; }

  private:
    MidiOutcome receive();
    void count(const ports::CanFrame& frame, const protocol::midi_can::Answer& answer);
    void transmit(base::Instant now);
    void watch_bus(base::Instant now);

    ports::CanPort& port_;
    std::uint8_t address_;
    protocol::midi_can::Request request_;
    bool busy_ = false;
    bool written_ = false;
    bool booted_ = false;
    bool cut_ = false;  ///< the port is down or bus-off, as last seen
    protocol::AnswerCount answers_;
    base::Instant deadline_{};
    base::Instant may_restart_{};
};

}  // namespace nplc::motor
