#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::motor {

/// Answer timeout, from a request's last character or its frame. R: in no manual.
inline constexpr base::Microseconds kLongestAnswer{100'000};

/// One command or query to a MIDI module; numbers as in registers/midi.h.
struct MidiMessage {
    bool is_query = false;
    std::uint8_t number = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const MidiMessage&) const = default;
};

/// The outcome of a message.
struct MidiOutcome {
    enum class Kind : std::uint8_t {
        none,       ///< no message has ended
        accepted,   ///< the command was carried out
        value,      ///< the query was answered
        refused,    ///< understood and not carried out
        not_taken,  ///< it did not reach the module, or was damaged on the way: not carried out
        unclear,    ///< no answer or a damaged one: a command may have been carried out or not
    };
    Kind kind = Kind::none;
    std::uint32_t value = 0;
    bool damaged = false;  ///< `unclear`, and something was received
};

/// Faults of the line, independent of the message in progress.
enum class MidiTrouble : std::uint8_t {
    none,
    no_bus,   ///< the CAN controller is down or bus-off
    several,  ///< more than one module answers to the address; until two requests have been answered once
              ///< each
};

/// One message at a time to one module. Nothing is repeated here: the driver decides whether a repeat is
/// harmless. Every message ends in bounded time.
class MidiLink {
  public:
    /// Of a message under way nothing is told any more.
    virtual void begin(const MidiMessage& message, base::Instant now) = 0;
    /// Sends and receives; returns an outcome once per message.
    virtual MidiOutcome poll(base::Instant now) = 0;
    virtual base::Instant next_poll(base::Instant now) const = 0;
    virtual bool busy() const = 0;
    /// The module has reported a restart; true once per restart. Only on CAN.
    virtual bool take_boot() = 0;
    virtual MidiTrouble trouble() const = 0;
    /// Drops a message that has not begun to be sent, without an outcome.
    virtual void withdraw() = 0;

  protected:
    ~MidiLink() = default;
};

}  // namespace nplc::motor
