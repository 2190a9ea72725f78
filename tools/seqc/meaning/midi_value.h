#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "meaning/model.h"
#include "registers/midi_motor.h"

namespace nplc::seqc {

/// What a MIDI drive makes of a register's value (firmware/motor/MIDI.md).
struct DriveValue {
    double raw = 0;    ///< what it will be, in the register's own steps
    std::string text;  ///< in the drive's own: "period 32", "120000 increments"
};

/// Nothing for registers whose value stays what it is, or depends on another one. The value has no lack.
std::optional<DriveValue> drive_value(registers::midi::Model model, const registers::Register& reg,
                                      std::uint32_t bits);

/// Why the drive cannot do what goes to the motor, as far as it tells alone.
registers::midi::Lack lack_of(registers::midi::Model model, const Send& send);

}  // namespace nplc::seqc
