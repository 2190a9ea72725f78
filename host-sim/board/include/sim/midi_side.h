#pragma once

#include <optional>
#include <string>

#include "motor/midi_can_link.h"
#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"
#include "sim/midi_drive.h"
#include "sim/scenario.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// A virtual MIDI drive in the place of the JVL motor: its line, the gateway's driver, and its shaft in JVL's
/// counts and samples.
class MidiSide {
  public:
    static constexpr Time kSamplePeriod = std::chrono::microseconds{1'920};

    MidiSide(const MidiDriveOptions& options, const LineFaults& faults);

    /// A new one; the one before is gone.
    motor::Motor& start_driver();
    const motor::MidiMotor& driver() const { return *driver_; }
    MidiDrive& drive() { return drive_; }
    const MidiDrive& drive() const { return drive_; }
    bool is_can() const { return options_.can; }
    /// `MAC34-1 over V24 at 38400 baud`
    std::string in_words() const;

    /// What the driver says of its ERROR; empty without one.
    std::string note() const;

    void sample();
    void fill(Snapshot& snapshot) const;

    void spoil(const action::SpoilLine& faults);
    void load(int torque);  ///< 1023 = full

  private:
    MidiDriveOptions options_;
    MidiDrive drive_;
    std::optional<motor::MidiV24Link> v24_;
    std::optional<motor::MidiCanLink> can_;
    std::optional<motor::MidiMotor> driver_;
    std::int32_t before_ = 0;
    std::int32_t speed_ = 0;
};

/// Of one direction, what `what` names.
void spoil(LineDirection& direction, const action::SpoilLine& what);

}  // namespace nplc::sim
