#pragma once

#include <cstdint>

#include "motor/midi_link.h"
#include "ports/can.h"
#include "protocol/midi_can.h"

namespace nplc::motor {

/// A MIDI module on a CAN bus (003 §V). A controller that is off the bus is restarted, once in
/// `restart_pause`.
class MidiCanLink final : public MidiLink {
  public:
    struct Settings {
        std::uint8_t address = 1;                    ///< 1..127
        base::Microseconds longest_answer{100'000};  ///< R: in no manual
        base::Microseconds restart_pause{100'000};
    };

    /// Sets the port's filters to the module's answers and boot-up.
    MidiCanLink(ports::CanPort& port, const Settings& settings);

    void begin(const MidiMessage& message, base::Instant now) override;
    MidiOutcome poll(base::Instant now) override;
    base::Instant next_poll(base::Instant) const override { return busy_ ? deadline_ : base::kNever; }
    bool busy() const override { return busy_; }
    bool take_boot() override;

  private:
    MidiOutcome receive();
    bool write(const protocol::midi_can::Frame& frame);
    void watch_bus(base::Instant now);

    ports::CanPort& port_;
    Settings settings_;
    protocol::midi_can::Request request_;
    bool busy_ = false;
    bool written_ = false;
    bool booted_ = false;
    base::Instant deadline_{};
    base::Instant may_restart_{};
};

}  // namespace nplc::motor
