#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/control_port.h"
#include "sim/scenario.h"

namespace nplc::sim {

/// A line at a simulator's control port: `status`, `help`, or what happens to the device now, written as an
/// action of a scenario (`motor load 500`, `motor power off for 2 s`).
ControlPort::Answer carry_out(std::string_view line, const Names& names,
                              const std::function<std::string()>& status,
                              const std::function<void(Actions)>& act);

}  // namespace nplc::sim
