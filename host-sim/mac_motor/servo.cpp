#include "sim/servo.h"

#include <algorithm>

namespace nplc::sim {
namespace {

/// Of the bare motor at full torque, 1/16 counts/sample^2; ours: 869,000 rpm/s, and 695,000 rpm/s on MAC800.
constexpr std::int32_t full_acceleration_16(registers::Model model) {
    return is_mac800(model) ? 2500 : 3500;
}

constexpr std::int32_t kFullTorque = 1023;

}  // namespace

Servo::Servo(registers::Model model, const Load& load)
    : plant_(full_acceleration_16(model), load), regulator_(full_acceleration_16(model)) {}

void Servo::power_up() {
    regulator_.reset();
    drive_ = {};
    result_ = {};
    last_counts_ = plant_.counts();
    v_ist_ = 0;
}

std::int32_t Servo::advance(MotorMemory&) {
    const bool passive = drive_.kind == Drive::Kind::shorted || drive_.kind == Drive::Kind::field ||
                         drive_.kind == Drive::Kind::voltage;
    if (passive) {
        plant_.short_circuit();
    } else {
        plant_.drive(result_.torque);
    }
    v_ist_ = static_cast<std::int32_t>(plant_.counts() - last_counts_);
    last_counts_ = plant_.counts();
    return v_ist_;
}

Servo::Result Servo::carry_out(const Drive& drive, MotorMemory& memory) {
    drive_ = drive;
    result_ = {};
    const std::int32_t limit = std::clamp(drive.torque_limit, 0, kFullTorque);
    if (drive.kind == Drive::Kind::velocity) {
        const std::int32_t kvout = memory.get(cell::KVOUT);
        const Regulator::Output out =
            regulator_.step({.fnc_out = drive.fnc_out,
                             .v_ist = v_ist_,
                             .torque_limit = limit,
                             .kvout_256 = is_mac800(memory.model()) ? kvout >> 8 : kvout});
        result_ = {out.torque, out.correction};
    } else {
        regulator_.reset();
        if (drive.kind == Drive::Kind::torque) {
            result_.torque = std::clamp(drive.torque, -kFullTorque, kFullTorque);
        } else if (drive.kind == Drive::Kind::analogue_torque) {
            const std::int32_t full = is_mac800(memory.model()) ? 2048 : 1023;
            const std::int64_t asked = std::int64_t{memory.get(cell::ANINP)} * limit / full;
            result_.torque = static_cast<std::int32_t>(std::clamp<std::int64_t>(asked, -limit, limit));
        }
    }
    memory.set(cell::VF_OUT, result_.torque);
    return result_;
}

}  // namespace nplc::sim
