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

/// A message that is to be sent, or nothing, as one number: on a microcontroller it stays in two registers,
/// where a std::optional<MidiMessage> goes through memory, at 200 bytes of flash.
enum class MidiNext : std::uint64_t { nothing = 0 };

constexpr MidiNext next_of(const MidiMessage& message) {
    const std::uint32_t about = 0x100'0000U | std::uint32_t{message.sub_index} << 16U |
                                std::uint32_t{message.number} << 8U | (message.is_query ? 1U : 0U);
    return MidiNext{std::uint64_t{about} << 32U | message.data};
}

/// Of one that is not `nothing`.
constexpr MidiMessage message_of(MidiNext next) {
    const auto about = static_cast<std::uint32_t>(static_cast<std::uint64_t>(next) >> 32U);
    return {.is_query = (about & 1U) != 0,
            .number = static_cast<std::uint8_t>(about >> 8U),
            .sub_index = static_cast<std::uint8_t>(about >> 16U),
            .data = static_cast<std::uint32_t>(next)};
}

constexpr MidiNext midi_query(std::uint8_t number, std::uint8_t sub_index = 0) {
    return next_of({.is_query = true, .number = number, .sub_index = sub_index});
}

constexpr MidiNext midi_command(std::uint8_t number, std::uint32_t data = 0) {
    return next_of({.number = number, .data = data});
}

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
enum class BusFault : std::uint8_t {
    none,
    no_bus,   ///< the CAN controller is down or bus-off
    several,  ///< more than one module answers to the address; until two requests have been answered once
              ///< each
};

/// One message at a time to one module. Nothing is repeated here: the driver decides whether a repeat is
/// harmless. Every message ends in bounded time.
class MidiLink {
  public:
    /// A message still in progress gets no outcome any more.
    virtual void begin(const MidiMessage& message, base::Instant now) = 0;
    /// Sends and receives; returns an outcome once per message.
    virtual MidiOutcome poll(base::Instant now) = 0;
    virtual base::Instant next_poll(base::Instant now) const = 0;
    virtual bool busy() const = 0;
    /// The module has reported a restart; true once per restart. Only on CAN.
    virtual bool take_boot() = 0;
    virtual BusFault trouble() const = 0;
    /// Drops a message that has not begun to be sent, without an outcome.
    virtual void withdraw() = 0;

  protected:
    ~MidiLink() = default;
};

}  // namespace nplc::motor
