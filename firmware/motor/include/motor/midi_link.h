#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::motor {

/// From a request's last character, or its frame, on. R: in no manual.
inline constexpr base::Microseconds kLongestAnswer{100'000};

/// One command or query to a MIDI module; numbers as in registers/midi.h.
struct MidiMessage {
    bool is_query = false;
    std::uint8_t number = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const MidiMessage&) const = default;
};

/// How a message ended.
struct MidiOutcome {
    enum class Kind : std::uint8_t {
        none,       ///< nothing has ended
        accepted,   ///< the command was carried out
        value,      ///< the query was answered
        refused,    ///< understood and not carried out
        not_taken,  ///< it never reached the module, or was damaged on the way: not carried out
        unclear,    ///< silence or a damaged answer: a command may have been carried out or not
    };
    Kind kind = Kind::none;
    std::uint32_t value = 0;
    bool damaged = false;  ///< `unclear`, and something was heard
};

/// What keeps a line from being used, whatever messages are under way.
enum class MidiTrouble : std::uint8_t {
    none,
    no_bus,   ///< the CAN controller is down or off the bus
    several,  ///< more than one module answers to the address; until two requests have been answered once
};

/// One message at a time to one module. Nothing is sent twice here: whether a repeat is harmless is for the
/// driver to say. Every message ends in bounded time.
class MidiLink {
  public:
    /// Needs !busy().
    virtual void begin(const MidiMessage& message, base::Instant now) = 0;
    /// Moves bytes or frames on; an outcome once for each message.
    virtual MidiOutcome poll(base::Instant now) = 0;
    virtual base::Instant next_poll(base::Instant now) const = 0;
    virtual bool busy() const = 0;
    /// The module has said that it started anew; once for each time. Only on CAN.
    virtual bool take_boot() = 0;
    virtual MidiTrouble trouble() const = 0;
    /// Drops a message of which nothing has left yet, without an outcome.
    virtual void withdraw() = 0;

  protected:
    ~MidiLink() = default;
};

}  // namespace nplc::motor
