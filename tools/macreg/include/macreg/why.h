#pragma once

#include "causes/why.h"
#include "macreg/motor.h"

namespace nplc::macreg {

/// Reads twice, 200 ms apart. `look_for_gateway`: also asks whether the motor is behind one.
Condition read_condition(Motor& motor, bool look_for_gateway = true);

}  // namespace nplc::macreg
