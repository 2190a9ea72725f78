#include "sim/motor_alone.h"

#include <algorithm>
#include <utility>

#include "registers/mac.h"
#include "sim/without_effect.h"

namespace nplc::sim {
namespace {

bool has_pulses(const Scenario& scenario) {
    const auto any = [](const auto& rules) {
        return std::any_of(rules.begin(), rules.end(), [](const auto& rule) {
            return std::any_of(rule.actions.begin(), rule.actions.end(), [](const Action& action) {
                return std::holds_alternative<action::MotorPulses>(action.what);
            });
        });
    };
    return any(scenario.at) || any(scenario.every) || any(scenario.when);
}

/// 001 §3.2.36: USERINTF = 00 selects the pulse input; other bits are kept.
void free_the_pins(MacMotor& motor) {
    constexpr std::uint32_t kUserInterface = 3;
    const std::uint32_t bits = motor.stored().read(registers::CNTRL_BITS, false);
    store(motor, {{.number = registers::CNTRL_BITS, .bits = bits & ~kUserInterface}});
}

}  // namespace

MotorAlone::MotorAlone(MacMotor& motor, const Scenario& scenario, const Names& names)
    : motor_(motor), runner_(scenario, names, *this) {
    if (names.free_pins && !is_mac800(motor.model()) && has_pulses(scenario)) free_the_pins(motor);
    store(motor, scenario.registers);
}

std::string MotorAlone::also(Actions actions, Time now) {
    std::string why = without_effect(motor_, powered_, actions);
    runner_.also(std::move(actions), now);
    return why;
}

void MotorAlone::observe(Time now) {
    Snapshot snapshot;
    snapshot.time = now;
    do {
        snapshot.p_ist = motor_.p_ist();
        snapshot.v_ist = motor_.v_ist();
        snapshot.shaft = motor_.plant().counts();
        snapshot.torque = motor_.torque();
    } while (runner_.observe(snapshot));
}

void MotorAlone::power_motor(bool on) {
    if (on && !powered_) switch_on(motor_);
    powered_ = on;
}

}  // namespace nplc::sim
