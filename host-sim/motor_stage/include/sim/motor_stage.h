#pragma once

#include <vector>

#include "sim/mac_motor.h"
#include "sim/scenario.h"

namespace nplc::sim {

void act(MacMotor& motor, const action::LoadMotor& load);
void act(MacMotor& motor, const action::MotorBrake& brake);
/// One that the shaft is beyond holds it where it is, but for a spring.
void act(MacMotor& motor, const action::StopMotor& stop);
void act(MacMotor& motor, const action::FreeMotor& free);
void act(MacMotor& motor, const action::MotorSensor& sensor);
void act(MacMotor& motor, const action::MotorAnalogue& analogue);
void act(MacMotor& motor, const action::MotorPulses& pulses);
void act(MacMotor& motor, const action::MotorSupply& supply);
void act(MacMotor& motor, const action::MotorTemperature& temperature);
void act(MacMotor& motor, const action::BreakEncoder& encoder);

/// Off and on again: registers from its flash, a whole encoder.
void switch_on(MacMotor& motor);
/// Into its flash, then off and on.
void store(MacMotor& motor, const std::vector<StoredRegister>& registers);

}  // namespace nplc::sim
