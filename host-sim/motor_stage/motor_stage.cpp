#include "sim/motor_stage.h"

#include <algorithm>
#include <cmath>

namespace nplc::sim {

void act(MacMotor& motor, const action::LoadMotor& load) {
    motor.plant().load().torque = load.torque;
}

void act(MacMotor& motor, const action::MotorBrake& brake) {
    motor.plant().load().brake_torque = brake.torque;
}

void act(MacMotor& motor, const action::StopMotor& stop) {
    Load& load = motor.plant().load();
    const std::int64_t shaft = motor.plant().counts();
    const std::int64_t place = stop.above ? std::max(stop.counts, shaft) : std::min(stop.counts, shaft);
    const bool rigid = stop.torque_per_count == 0;
    (stop.above ? load.high_stop : load.low_stop) =
        MechanicalStop{rigid ? place : stop.counts, std::llround(1024 * stop.torque_per_count)};
}

void act(MacMotor& motor, const action::FreeMotor&) {
    motor.plant().load().low_stop.reset();
    motor.plant().load().high_stop.reset();
}

void act(MacMotor& motor, const action::MotorSensor& sensor) {
    motor.terminals().connect({.counts = sensor.counts, .on_above = sensor.on_above});
}

void act(MacMotor& motor, const action::MotorAnalogue& analogue) {
    motor.terminals().set_analogue(static_cast<std::int32_t>(std::lround(1000 * analogue.volts)));
}

void act(MacMotor& motor, const action::MotorPulses& pulses) {
    motor.terminals().set_pulse_rate(pulses.per_second, pulses.with_direction
                                                            ? PulseFormat::pulse_and_direction
                                                            : PulseFormat::quadrature);
}

void act(MacMotor& motor, const action::MotorSupply& supply) {
    if (!supply.logic) {
        motor.supply().set_source(supply.volts);
        return motor.supply().settle();  // a motor at rest would never empty its bus
    }
    motor.surroundings().logic_millivolts = static_cast<std::int32_t>(std::lround(1000 * supply.volts));
}

void act(MacMotor& motor, const action::MotorTemperature& temperature) {
    motor.surroundings().celsius = temperature.celsius;
}

void act(MacMotor& motor, const action::BreakEncoder&) {
    motor.surroundings().encoder_broken = true;
}

void switch_on(MacMotor& motor) {
    motor.surroundings().encoder_broken = false;
    motor.power_cycle();
}

void store(MacMotor& motor, const std::vector<StoredRegister>& registers) {
    if (registers.empty()) return;
    MotorMemory flash = motor.stored();
    for (const StoredRegister& one : registers) {
        const registers::Register* reg = registers::find(motor.model(), one.number);
        const bool wide = is_mac800(motor.model()) || (reg != nullptr && registers::is_32_bit(reg->format));
        flash.write(one.number, one.bits, wide);
    }
    motor.set_stored(flash);
    motor.power_cycle();
}

}  // namespace nplc::sim
