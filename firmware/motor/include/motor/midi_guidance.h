#pragma once

#include <cstdint>
#include <optional>

#include "motor/midi_drive.h"
#include "motor/midi_link.h"
#include "motor/midi_motion.h"
#include "motor/midi_registers.h"
#include "registers/midi_motor.h"

namespace nplc::motor {

/// Determines the next command that brings a MIDI drive to the state in the registers, one command at a time
/// (MIDI.md in this folder). Does not send it and changes no state of the drive.
class MidiGuidance {
  public:
    using Limitation = registers::midi::Limitation;

    MidiGuidance(const MidiRegisters& registers, const MidiDrive& drive, const MidiMotion& motion)
        : registers_(registers), drive_(drive), motion_(motion) {}

    /// TORQUE or TOLERANCE, if the drive's value differs.
    MidiNext next_parameter() const;
    /// For velocity mode (MODE_REG 1) and position mode (2). Nothing while the command must wait for
    /// standstill, or the drive already does what is wanted, or no drive can do it: then limitation() has the
    /// reason.
    MidiNext next_motion();
    Limitation limitation() const { return limitation_; }
    /// P_SOLL in increments; empty if it is beyond a drive's range.
    std::optional<std::int32_t> target() const;

  private:
    MidiNext next_for_run();
    MidiNext next_for_move();
    MidiNext stop_first() const;
    MidiNext refuse(Limitation why);
    bool fit_ramp(std::uint16_t period, std::uint8_t& ramp);

    const MidiRegisters& registers_;
    const MidiDrive& drive_;
    const MidiMotion& motion_;
    Limitation limitation_ = Limitation::none;
};

}  // namespace nplc::motor
