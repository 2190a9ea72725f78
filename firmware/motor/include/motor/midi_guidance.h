#pragma once

#include <cstdint>
#include <optional>

#include "motor/midi_drive.h"
#include "motor/midi_link.h"
#include "motor/midi_motion.h"
#include "motor/midi_registers.h"
#include "registers/midi_motor.h"

namespace nplc::motor {

/// Leads a MIDI drive to what the registers say, one command at a time (MIDI.md in this folder). It works the
/// commands out and changes nothing.
class MidiGuidance {
  public:
    using Message = std::optional<MidiMessage>;
    using Limitation = registers::midi::Limitation;

    MidiGuidance(const MidiRegisters& registers, const MidiDrive& drive, const MidiMotion& motion)
        : registers_(registers), drive_(drive), motion_(motion) {}

    /// TORQUE or TOLERANCE, if the drive has another.
    Message next_parameter() const;
    /// In velocity mode (MODE_REG 1) and position mode (2). Nothing while that has to wait for standstill, or
    /// the drive does what is wanted, or no drive can: then limitation() says why.
    Message next_motion();
    Limitation limitation() const { return limitation_; }
    /// P_SOLL in increments; nothing if it is beyond what a drive can count.
    std::optional<std::int32_t> target() const;

  private:
    Message next_for_run();
    Message next_for_move();
    Message stop_first() const;
    Message refuse(Limitation why);
    bool fit_ramp(std::uint16_t period, std::uint8_t& ramp);

    const MidiRegisters& registers_;
    const MidiDrive& drive_;
    const MidiMotion& motion_;
    Limitation limitation_ = Limitation::none;
};

}  // namespace nplc::motor
