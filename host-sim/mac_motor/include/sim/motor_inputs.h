#pragma once

#include "sim/motor_state.h"
#include "sim/terminals.h"

namespace nplc::sim {

/// What the motor reads of its terminals and surroundings in each sample: ANINP and its logic level, V_EXT,
/// DEGC and U_24V (001 §3.2.120, §3.2.122; 004).
class MotorInputs {
  public:
    explicit MotorInputs(MotorState& state) : state_(state), level_(state.model()) {}

    void power_up();
    /// `counts`: of the shaft.
    void read(std::int64_t counts);

    const PulseInput& pulse_input() const { return pulse_input_; }
    /// The analogue input is on.
    bool level() const { return level_.on(); }
    /// It was not what it is in the sample before.
    bool level_changed() const { return level_.on() != level_was_on_; }

    Terminals terminals;
    Surroundings surroundings;

  private:
    MotorState& state_;
    PulseInput pulse_input_;
    AnalogueVoltage voltage_;
    AnalogueLevel level_;
    bool level_was_on_ = false;
};

}  // namespace nplc::sim
