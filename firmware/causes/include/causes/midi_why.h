#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "causes/why.h"
#include "registers/midi.h"
#include "registers/midi_motor.h"
#include "registers/vocabulary.h"

/// Diagnoses why a MIDI drive does not move (000 §VI, 003 §IV, §VII).
namespace nplc::causes {

/// Readings of a module that the gateway's driver does not poll.
struct MidiReadings {
    std::uint32_t end_stops = 0;  ///< END_STOPS
    std::uint32_t terminals = 0;  ///< GET_MEASURES
    std::int64_t position = 0;
    std::int64_t upper_stop = 0;
    std::int64_t lower_stop = 0;
    std::uint8_t temperature = 0;
    bool operator==(const MidiReadings&) const = default;
};

/// The gateway's driver of it.
struct MidiDriver {
    registers::gateway::DriveFault fault = registers::gateway::DriveFault::none;
    registers::midi::Limitation limitation = registers::midi::Limitation::none;  ///< of a bad_value
    bool is_at_target = false;                                                   ///< in position mode, IN_POS
    bool has_no_speed = false;  ///< a mode with motion is selected, and V_SOLL is 0
    bool operator==(const MidiDriver&) const = default;
};

/// A MIDI drive as it, or the gateway that controls it, reports itself; unknown values are left out. A plain
/// value.
struct MidiState {
    std::optional<registers::midi::Model> model{};
    std::uint32_t status = 0;              ///< GET_STATUS
    bool turns = false;                    ///< its position has changed a moment ago
    bool is_stuck = false;                 ///< it is to move, and has not for a while
    std::optional<std::int64_t> torque{};  ///< as TORQUE has it
    std::int64_t most_torque = 0;          ///< Imax
    std::optional<std::int64_t> period{};  ///< as SPEED has it
    std::optional<MidiReadings> readings{};
    std::optional<MidiDriver> driver{};
    bool operator==(const MidiState&) const = default;
};

/// The readings with units, where these are known.
struct MidiTexts {
    std::string distance{};  ///< ": 20 inc in 200 ms"
    std::string speed{};
};

/// The causes that keep it from moving, the most urgent first; a finding that it moves comes first. Never
/// empty.
std::vector<Finding> why(const MidiState& drive, const std::optional<GatewayState>& gateway = {},
                         const MidiTexts& texts = {});

}  // namespace nplc::causes
