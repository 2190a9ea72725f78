#pragma once

#include <cstdint>

#include "sim/drive.h"
#include "sim/motor_memory.h"
#include "sim/plant.h"
#include "sim/regulator.h"

namespace nplc::sim {

/// Everything below the profile: regulators, windings, supply and shaft. A sample of the outer loop is
/// `advance`, then the mode makes its Drive, then `carry_out`.
class Servo {
  public:
    struct Result {
        std::int32_t torque = 0;      ///< VF_OUT
        std::int32_t correction = 0;  ///< what FNC_OUT should have been less what it was (001 §4.2.1)
    };

    Servo(registers::Model model, const Load& load);

    /// One outer sample with what was asked for last. Answers the encoder counts of that sample (V_IST).
    std::int32_t advance(MotorMemory& memory);
    /// What the next sample is to do. Writes VF_OUT. Unless the Drive is `velocity` the speed regulator
    /// forgets what it was at.
    Result carry_out(const Drive& drive, MotorMemory& memory);

    /// As after power-up: windings shorted. The shaft stays where it is.
    void power_up();
    /// Profile and shaft are at the same place and run at `velocity`, 1/16 counts/sample, in the next sample.
    void restart(std::int32_t velocity) { regulator_.restart(velocity); }

    std::int32_t torque() const { return result_.torque; }  ///< VF_OUT of the sample that ran last
    const Drive& drive() const { return drive_; }
    /// How far the shaft is behind the profile, corrections taken off, 1/16 counts.
    std::int64_t lag_16() const { return regulator_.lag_16(); }
    /// Encoder counts since the motor was built, as the last sample read them.
    std::int64_t counts() const { return last_counts_; }

    Plant& plant() { return plant_; }
    const Plant& plant() const { return plant_; }

  private:
    Plant plant_;
    Regulator regulator_;
    Drive drive_;
    Result result_;
    std::int64_t last_counts_ = 0;
    std::int32_t v_ist_ = 0;
};

}  // namespace nplc::sim
