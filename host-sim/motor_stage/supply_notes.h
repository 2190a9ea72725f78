#pragma once

#include <string>

#include "sim/scenario.h"

namespace nplc::sim {

/// What a motor of any kind does not follow for lack of its supply, or of a timeline.
struct SupplyNotes {
    bool powered;

    std::string operator()(const action::PowerMotor& power) const {
        if (powered != power.on) return {};
        return power.on ? "it has its supply already" : needs_power();
    }
    std::string operator()(const action::FailMotor&) const { return needs_power(); }
    std::string operator()(const action::BreakEncoder&) const { return needs_power(); }
    std::string operator()(const action::MotorSupply&) const { return needs_power(); }
    std::string operator()(const action::MotorTemperature&) const { return needs_power(); }
    std::string operator()(const action::Log&) const { return "there is no timeline here"; }

    std::string needs_power() const {
        return powered ? std::string() : std::string("it has no supply (motor power off)");
    }
};

}  // namespace nplc::sim
