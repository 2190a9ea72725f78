#pragma once

#include <vector>

#include "sim/mac_motor.h"
#include "sim/scenario.h"

namespace nplc::sim {

/// A stop that the shaft is beyond holds it where it is, but for a spring. Inputs of a MIDI module it has
/// not.
void act(MacMotor& motor, const action::OnMotor& what);

/// Off and on again: registers from its flash, a whole encoder.
void switch_on(MacMotor& motor);
/// Into its flash, then off and on.
void store(MacMotor& motor, const std::vector<StoredRegister>& registers);

}  // namespace nplc::sim
