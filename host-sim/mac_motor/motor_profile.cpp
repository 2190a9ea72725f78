#include <algorithm>
#include <cstdlib>

#include "sim/analogue_blocks.h"
#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

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
    switch (static_cast<MotorMode>(mode())) {
        case MotorMode::stop:
            return kFullTorque;
        case MotorMode::home1:
            return Homing::torque_limit(memory_.get(cell::T_HOME));
        case MotorMode::velocity_analogue_torque:
            return analogue_torque_limit(model(), memory_.get(cell::ANINP), memory_.get(cell::T_SOLL));
        default:
            return memory_.get(cell::T_SOLL);
    }
}

void MacMotor::run_profile() {
    const auto towards = [&](std::int32_t velocity) {
        regulate(velocity_block(velocity, v_from_, acceleration()));
    };
    switch (facts().block) {
        case ModeFacts::Block::velocity:
            return towards(v_soll());
        case ModeFacts::Block::analogue_velocity:
            return towards(analogue_v_soll());
        case ModeFacts::Block::homing:
            return towards(homing_.velocity());
        case ModeFacts::Block::position:
            set_target_by_voltage();
            return run_position();
        case ModeFacts::Block::gear:
            return run_gear();
        case ModeFacts::Block::coil:
            return run_coil();
        case ModeFacts::Block::stop:
        case ModeFacts::Block::none:
            return towards(0);
    }
}

/// What the end of a move may count on.
std::int32_t MacMotor::braking(std::int64_t distance, std::int32_t acceleration) {
    if (v_from_ == 0 && distance == 0) corrected_braking_ = 0;
    return corrected_braking_ == 0 ? acceleration : std::min(corrected_braking_, acceleration);
}

/// With the position block, to what is `distance` away.
void MacMotor::run_to(std::int64_t distance) {
    const std::int32_t acceleration = this->acceleration();
    const std::int32_t limit = std::abs(v_soll());
    regulate(position_block(distance, v_from_, limit, acceleration, braking(distance, acceleration)));
}

void MacMotor::run_position() {
    const std::int64_t distance = distance_16();
    if (distance != distance_to_go_) corrected_braking_ = 0;  // a new target: what was learnt is not of it
    run_to(distance);
    distance_to_go_ = wrap32(distance - v_old_);
}

void MacMotor::regulate(std::int32_t fnc_out) {
    const Servo::Result out = servo_.carry_out(
        {.kind = Drive::Kind::velocity, .fnc_out = fnc_out, .torque_limit = torque_limit()}, memory_);
    bool thrown_back = false;
    if (facts().corrected) {
        const std::int32_t wanted = fnc_out;
        learn_braking(wanted, out.correction);
        fnc_out = std::clamp(wanted + out.correction, -kBound, kBound);
        thrown_back = out.correction != 0 && std::int64_t{wanted} * fnc_out < 0;
    }
    const std::int64_t corrected = facts().corrected ? std::int64_t{memory_.get(cell::FNCERR)} : 0;
    memory_.set(cell::FNCERR, facts().corrected ? wrap32(corrected + out.correction) : 0);
    follow_error_16_ += fnc_out - 16 * v_ist();
    memory_.set(cell::FLWERR, is_mode(MotorMode::stop) ? 0 : wrap32(follow_error_16_ / 16));
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + fnc_out));
    show_profile(fnc_out);
    go_on_from(fnc_out, thrown_back);
}

// R: a profile that the torque limit has turned round, as at a hard stop, is not held to A_SOLL on its way
// back: it would leave the stop and come again.
void MacMotor::go_on_from(std::int32_t fnc_out, bool thrown_back) {
    v_old_ = fnc_out;
    v_from_ = thrown_back ? 0 : fnc_out;
}

// R: a move whose braking had to be corrected is planned with less of it to its end, or it would swing about
// its target.
// Gear modes have no such end: there it comes back.
void MacMotor::learn_braking(std::int32_t wanted, std::int32_t correction) {
    if (correction == 0 && facts().geared() && corrected_braking_ != 0) {
        corrected_braking_ += corrected_braking_ / 64 + 1;
        if (corrected_braking_ >= acceleration()) corrected_braking_ = 0;
    }
    if (correction == 0 || std::abs(wanted) >= std::abs(v_from_)) return;
    const std::int32_t before = corrected_braking_ == 0 ? acceleration() : corrected_braking_;
    corrected_braking_ = std::max(before - before / 16 - 1, 1);
}

void MacMotor::show_profile(std::int32_t fnc_out) {
    const std::uint32_t flags = fnc_out > v_old_ ? err::ACC_FLAG : fnc_out < v_old_ ? err::DEC_FLAG : 0;
    show_error_bits(err::ACC_FLAG | err::DEC_FLAG, flags);
    memory_.set(cell::FNC_OUT, is_mac800(model()) ? wrap32(std::int64_t{fnc_out} * 0x10000) : fnc_out);
}

void MacMotor::judge_in_position() {
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
    switch (facts().in_position) {
        case ModeFacts::InPosition::never:
            return false;
        case ModeFacts::InPosition::position:
            return std::abs(distance_16() + follow_error_16_) < 16 * window;
        case ModeFacts::InPosition::gear:
            return std::abs(gear_.g_fnc()) < 16 * window;
        case ModeFacts::InPosition::velocity:
            break;
    }
    if (memory_.get(cell::INPOSCNT) == 0) return std::abs(std::int64_t{v_ist()}) < window;
    return std::abs(std::int64_t{v_soll()} - 16 * std::int64_t{v_ist()}) < window;
}

}  // namespace nplc::sim
