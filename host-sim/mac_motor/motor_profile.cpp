#include <algorithm>
#include <cstdlib>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr std::int32_t kFullTorque = 1023;
constexpr std::int32_t kBound =
    0xFFFF;  // of velocities and accelerations in 1/16: MAC800 registers hold more

std::int32_t magnitude(std::int32_t value) {
    return static_cast<std::int32_t>(std::min<std::int64_t>(std::abs(std::int64_t{value}), kBound));
}

}  // namespace

std::int32_t MacMotor::v_soll() const {
    return std::clamp(memory_.get(cell::V_SOLL), -kBound, kBound);
}

std::int32_t MacMotor::acceleration() const {
    const std::int32_t normal = magnitude(memory_.get(cell::A_SOLL));
    if (!is_mode(MotorMode::stop)) return normal;
    const std::int32_t hard = magnitude(memory_.get(cell::ACC_EMERG));
    return std::max(emergency_ && hard != 0 ? hard : normal, 1);
}

/// To P_SOLL, on the ring that P_FNC runs on.
std::int64_t MacMotor::distance_16() const {
    return wrap32(16 * std::int64_t{memory_.get(cell::P_SOLL)} - memory_.get(cell::P_FNC));
}

std::int32_t MacMotor::torque_limit() const {
    if (is_mode(MotorMode::stop)) return kFullTorque;
    if (is_mode(MotorMode::home1)) return Homing::torque_limit(memory_.get(cell::T_HOME));
    return memory_.get(cell::T_SOLL);
}

void MacMotor::run_profile() {
    switch (static_cast<MotorMode>(mode())) {
        case MotorMode::position:
            return run_position();
        case MotorMode::gear_position:
        case MotorMode::gear_follow:
            return run_gear();
        case MotorMode::home1:
        case MotorMode::home2:
        case MotorMode::home3:
            return regulate(velocity_block(homing_.velocity(), v_old_, acceleration()));
        case MotorMode::stop:
            return regulate(velocity_block(0, v_old_, acceleration()));
        default:
            return regulate(velocity_block(v_soll(), v_old_, acceleration()));
    }
}

/// What the end of a move may count on.
std::int32_t MacMotor::braking(std::int64_t distance) {
    if (v_old_ == 0 && distance == 0) corrected_braking_ = 0;
    return corrected_braking_ == 0 ? acceleration() : std::min(corrected_braking_, acceleration());
}

void MacMotor::run_position() {
    const std::int64_t distance = distance_16();
    if (distance != distance_to_go_) corrected_braking_ = 0;  // a new target: what was learnt is not of it
    regulate(position_block(distance, v_old_, std::abs(v_soll()), acceleration(), braking(distance)));
    distance_to_go_ = wrap32(distance - v_old_);
}

void MacMotor::run_gear() {
    gear_.take(memory_.get(cell::V_EXT), memory_.get(cell::GEARF1), memory_.get(cell::GEARF2));
    const std::int64_t distance = -gear_.g_fnc();
    const std::int32_t limit = std::abs(v_soll());
    if (is_mode(MotorMode::gear_position)) {
        regulate(position_block(distance, v_old_, limit, acceleration(), braking(distance)));
    } else {
        regulate(gear_follow_block(gear_.g_fnc(), v_old_, limit, acceleration()));
    }
    gear_.went(v_old_);
    memory_.set(cell::G_FNC, wrap32(gear_.g_fnc()));
    memory_.set(cell::FNCERR, wrap32(gear_.g_fnc()));  // here a positioning error (001 §3.2.24)
}

void MacMotor::regulate(std::int32_t fnc_out) {
    const Servo::Result out = servo_.carry_out(
        {.kind = Drive::Kind::velocity, .fnc_out = fnc_out, .torque_limit = torque_limit()}, memory_);
    if (facts().corrected) {
        learn_braking(fnc_out, out.correction);
        fnc_out += out.correction;
    }
    if (is_mode(MotorMode::position)) {
        memory_.set(cell::FNCERR, wrap32(std::int64_t{memory_.get(cell::FNCERR)} + out.correction));
    }
    follow_error_16_ += fnc_out - 16 * v_ist();
    memory_.set(cell::FLWERR, wrap32(follow_error_16_ / 16));
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + fnc_out));
    show_profile(fnc_out);
    v_old_ = fnc_out;
}

// R: a move whose braking had to be corrected is planned with less of it to its end, or it would swing about
// its target.
// Gear modes have no such end: there it comes back.
void MacMotor::learn_braking(std::int32_t wanted, std::int32_t correction) {
    if (correction == 0 && !is_mode(MotorMode::position) && corrected_braking_ != 0) {
        corrected_braking_ += corrected_braking_ / 64 + 1;
        if (corrected_braking_ >= acceleration()) corrected_braking_ = 0;
    }
    if (correction == 0 || std::abs(wanted) >= std::abs(v_old_)) return;
    const std::int32_t before = corrected_braking_ == 0 ? acceleration() : corrected_braking_;
    corrected_braking_ = std::max(before - before / 16 - 1, 1);
}

void MacMotor::show_profile(std::int32_t fnc_out) {
    set_error_bits(err::ACC_FLAG, fnc_out > v_old_);
    set_error_bits(err::DEC_FLAG, fnc_out < v_old_);
    memory_.set(cell::FNC_OUT, is_mac800(model()) ? wrap32(std::int64_t{fnc_out} * 0x10000) : fnc_out);
}

void MacMotor::judge_in_position() {
    if (is_mode(MotorMode::stop) || facts().homing) return clear_in_position();
    if (!within_window()) return clear_in_position();
    ++samples_within_;
    if (samples_within_ < memory_.get(cell::INPOSCNT)) return;
    samples_within_ = std::max(memory_.get(cell::INPOSCNT), 0);
    set_error_bits(err::IN_POS, true);
}

// 001 §4.1.1 for velocity mode (R: the text has three versions), §4.4.3 for position mode, §4.4.4 for the
// gear modes (R: P_FNC there is the block's own G_FNC).
bool MacMotor::within_window() const {
    const std::int64_t window = memory_.get(cell::INPOSWIN);
    if (is_mode(MotorMode::position)) return std::abs(distance_16() + follow_error_16_) < 16 * window;
    if (facts().corrected) return std::abs(gear_.g_fnc()) < 16 * window;
    if (memory_.get(cell::INPOSCNT) == 0) return std::abs(std::int64_t{v_ist()}) < window;
    return std::abs(std::int64_t{v_soll()} - 16 * std::int64_t{v_ist()}) < window;
}

}  // namespace nplc::sim
