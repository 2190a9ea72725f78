#pragma once

#include <cstdint>

#include "protocol/fastmac.h"
#include "sim/mode_control.h"
#include "sim/motion_profile.h"
#include "sim/motor_state.h"

namespace nplc::sim {

/// Effects of FastMAC commands on the registers (001 §5.2.1.4), and register mode (001 §3.2.43 - 48).
class MotorCommands {
  public:
    MotorCommands(MotorState& state, MotionProfile& profile, ModeControl& modes)
        : state_(state), memory_(state.memory), profile_(profile), modes_(modes) {}

    void execute(const protocol::fastmac::Command& command);
    /// P_REG_P ... Z_REG_P, after a line has written registers.
    void act_on_pointers();

  private:
    void execute_number(protocol::fastmac::Number number);
    void select(protocol::fastmac::Group group, int index);
    void select_set(int index);
    void set_relative(bool p_soll, bool p_fnc);
    void copy(Cell from, Cell to) { memory_.set(to, memory_.get(from)); }

    MotorState& state_;
    MotorMemory& memory_;
    MotionProfile& profile_;
    ModeControl& modes_;
};

}  // namespace nplc::sim
