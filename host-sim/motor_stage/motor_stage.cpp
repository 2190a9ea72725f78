#include "sim/motor_stage.h"

#include <algorithm>
#include <cmath>

namespace nplc::sim {

namespace {

struct Actor {
    MacMotor& motor;

    void operator()(const action::LoadMotor& load) const { motor.plant().load().torque = load.torque; }

    void operator()(const action::MotorBrake& brake) const {
        motor.plant().load().brake_torque = brake.torque;
    }

    void operator()(const action::StopMotor& stop) const {
        Load& load = motor.plant().load();
        const std::int64_t shaft = motor.plant().counts();
        const std::int64_t place = stop.above ? std::max(stop.counts, shaft) : std::min(stop.counts, shaft);
        const bool rigid = stop.torque_per_count == 0;
        (stop.above ? load.high_stop : load.low_stop) =
            MechanicalStop{rigid ? place : stop.counts, std::llround(1024 * stop.torque_per_count)};
    }

    void operator()(const action::FreeMotor&) const {
        motor.plant().load().low_stop.reset();
        motor.plant().load().high_stop.reset();
    }

    void operator()(const action::MotorSensor& sensor) const {
        motor.terminals().connect({.counts = sensor.counts, .on_above = sensor.on_above});
    }

    void operator()(const action::MotorAnalogue& analogue) const {
        motor.terminals().set_analogue(static_cast<std::int32_t>(std::lround(1000 * analogue.volts)));
    }

    void operator()(const action::MotorPulses& pulses) const {
        motor.terminals().set_pulse_rate(pulses.per_second, pulses.with_direction
                                                                ? PulseFormat::pulse_and_direction
                                                                : PulseFormat::quadrature);
    }

    void operator()(const action::MotorSupply& supply) const {
        if (!supply.logic) {
            motor.supply().set_source(supply.volts);
            return motor.supply().settle();  // the bus of a motor at rest would never discharge
        }
        motor.surroundings().logic_millivolts = static_cast<std::int32_t>(std::lround(1000 * supply.volts));
    }

    void operator()(const action::MotorTemperature& temperature) const {
        motor.surroundings().celsius = temperature.celsius;
    }

    void operator()(const action::BreakEncoder&) const { motor.surroundings().encoder_broken = true; }

    void operator()(const action::SetDriveInput&) const {}
    void operator()(const action::DriveSwitch&) const {}
};

}  // namespace

void act(MacMotor& motor, const action::OnMotor& what) {
    std::visit(Actor{motor}, what);
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
