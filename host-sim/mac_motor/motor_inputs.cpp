#include "sim/motor_inputs.h"

#include "sim/profile_blocks.h"

namespace nplc::sim {

void MotorInputs::power_up() {
    pulse_input_.configure(state_.model(), state_.memory.get(cell::CNTRL_BITS),
                           state_.memory.get(cell::HW_SETUP));
    level_ = AnalogueLevel(state_.model());
    level_was_on_ = false;
}

void MotorInputs::read(std::int64_t counts) {
    MotorMemory& memory = state_.memory;
    const std::int32_t voltage = voltage_.of(state_.model(), terminals.millivolts(counts));
    memory.set(cell::ANINP, wrap32(std::int64_t{voltage} + memory.get(cell::ANINP_OFFSET)));
    level_was_on_ = level_.on();
    level_.update(memory.get(cell::ANINP));
    if (state_.is_mac800()) {
        memory.set(cell::DEGC, memory.get(cell::DEGC) + surroundings.degc());
        memory.set(cell::U_24V, surroundings.u_24v());
    }

    const std::int32_t pulses = terminals.next_pulses(state_.sample_period(), pulse_input_);
    if (!state_.facts().counts_pulses) return;
    const std::int64_t turned = state_.is_mode(MotorMode::coil) ? memory.get(cell::V1[7]) : 0;  // 001 §4.4.20
    memory.set(cell::V_EXT, wrap32(pulses + turned));
}

}  // namespace nplc::sim
