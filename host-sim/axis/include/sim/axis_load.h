#pragma once

#include "plant_file/plant_file.h"
#include "sim/plant.h"

namespace nplc::sim {

/// What a plant makes of a virtual motor's shaft; what it does not tell is as it was in `load`.
Load load_of(const plant_file::Plant& plant, registers::Model model, Load load = {});

}  // namespace nplc::sim
