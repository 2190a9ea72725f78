#pragma once

#include <string>

#include "plant_file/plant_file.h"
#include "sim/axis_load.h"
#include "sim/scenario.h"

namespace nplc::sim {

struct AxisReading {
    plant_file::Plant plant{};
    Load load{};
    std::string error{};  ///< one line, with file, position and remedy; empty on success
};
/// Reads the file of `--plant`, for a motor of this model.
AxisReading read_axis(const std::string& file, registers::Model model);

/// The file named by `option`, else the scenario's line; without either the bare motor.
AxisReading read_axis(const std::string& option, const Scenario& scenario, registers::Model model);

}  // namespace nplc::sim
