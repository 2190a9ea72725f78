#pragma once

#include <cstdint>
#include <cstdlib>

#include "sim/mode_control.h"
#include "sim/motor_inputs.h"
#include "sim/motor_state.h"
#include "sim/servo.h"

namespace nplc::sim {

/// 001 §4.5 and the errors of 004's ERR_STAT: monitoring in every sample and every mode.
class MotorMonitor {
  public:
    MotorMonitor(MotorState& state, ModeControl& modes, const Servo& servo, const Surroundings& surroundings)
        : state_(state), memory_(state.memory), modes_(modes), servo_(servo), surroundings_(surroundings) {}

    void power_up() { uv_timer_ = 0; }
    [[gnu::flatten]] void watch();

  private:
    void watch_limits();
    void watch_supply();
    void watch_currents();
    void watch_mac800();
    /// A limit of 0 means no limit (001 §4.5.4, §4.5.5).
    bool exceeds(Cell value, Cell limit) const {
        const std::int64_t most = memory_.get(limit);
        return most > 0 && std::abs(std::int64_t{memory_.get(value)}) > most;
    }
    bool is_above(Cell value, Cell limit) const { return memory_.get(value) > memory_.get(limit); }

    MotorState& state_;
    MotorMemory& memory_;
    ModeControl& modes_;
    const Servo& servo_;
    const Surroundings& surroundings_;
    std::int32_t uv_timer_ = 0;  // UV_TIMER, samples
};

}  // namespace nplc::sim
