#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/control_port.h"
#include "sim/scenario.h"

namespace nplc::sim {

/// Carries out a line of a simulator's control port: `status`, `help`, or an action on the device, written as
/// in a scenario (`motor load 500`, `motor power off for 2 s`). `act` returns why nothing follows from the
/// actions, which becomes a part of the answer, or nothing.
ControlPort::Answer carry_out(std::string_view line, const Names& names,
                              const std::function<std::string()>& status,
                              const std::function<std::string(Actions)>& act);

}  // namespace nplc::sim
