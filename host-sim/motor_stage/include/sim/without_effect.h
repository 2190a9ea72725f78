#pragma once

#include <string>
#include <string_view>

#include "sim/mac_motor.h"
#include "sim/midi_module.h"
#include "sim/scenario.h"

namespace nplc::sim {

/// Why an action does nothing to a motor in its present state, as a phrase: "the motor is passive in
/// INIT_MODE ...". Empty: it does something, or it is none on the motor. `powered`: the motor has its supply.
std::string without_effect(const MacMotor& motor, bool powered, const Action& action);
std::string without_effect(const MidiModule& module, bool powered, const Action& action);

/// An action on the motor as a scenario has it, without its values: "motor pulses".
std::string_view name_of(const Action& action);

/// The same of all actions of a line that happen at once; the first that does nothing.
template <class Motor>
std::string without_effect(const Motor& motor, bool powered, const Actions& actions) {
    for (const Action& action : actions) {
        if (action.after != Time{0}) continue;
        if (std::string why = without_effect(motor, powered, action); !why.empty()) return why;
        if (const auto* power = std::get_if<action::PowerMotor>(&action.what)) powered = power->on;
    }
    return {};
}

}  // namespace nplc::sim
