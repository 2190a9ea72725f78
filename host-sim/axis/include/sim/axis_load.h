#pragma once

#include "plant_file/plant_file.h"
#include "sim/plant.h"

namespace nplc::sim {

/// The load of a virtual motor's shaft as a plant file describes it; missing values are those of `load`.
Load load_of(const plant_file::Plant& plant, registers::Model model, Load load = {});

}  // namespace nplc::sim
