#include "sim/axis_load.h"

#include <cmath>

namespace nplc::sim {

Load load_of(const plant_file::Plant& plant, registers::Model model, Load load) {
    const plant_file::Load found = plant_file::in_motor_terms(plant, model);
    const plant_file::Motor motor = plant_file::motor_of(model);
    if (found.inertia) load.inertia_256 = 256 * *found.inertia;
    if (found.coulomb_friction) load.friction_torque = *found.coulomb_friction;
    if (found.viscous_friction) load.viscous_torque = *found.viscous_friction;
    if (found.constant_load) load.torque = *found.constant_load;
    if (found.dead_time) {
        const double late = *found.dead_time - motor.current_delay / motor.sample;
        load.late_inner_samples =
            late <= 0 ? 0 : static_cast<std::int32_t>(std::lround(late * kInnerSamples));
    }
    return load;
}

}  // namespace nplc::sim
