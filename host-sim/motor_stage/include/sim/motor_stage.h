#pragma once

#include <vector>

#include "sim/mac_motor.h"
#include "sim/scenario.h"

namespace nplc::sim {

/// A rigid stop that the shaft is beyond holds it in place. Inputs of a MIDI module are not supported.
void act(MacMotor& motor, const action::OnMotor& what);

/// Power off and on: registers from the flash, encoder repaired.
void switch_on(MacMotor& motor);
/// Stores into the flash, then power off and on.
void store(MacMotor& motor, const std::vector<StoredRegister>& registers);

}  // namespace nplc::sim
