#include "sim/motion_profile.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr std::int32_t kBound =
    0xFFFF;  // of velocities and accelerations in 1/16: MAC800 registers hold more

std::int32_t magnitude(std::int32_t value) {
    return static_cast<std::int32_t>(std::min<std::int64_t>(std::abs(std::int64_t{value}), kBound));
}

}  // namespace

void MotionProfile::power_up() {
    v_old_ = v_from_ = samples_within_ = corrected_braking_ = 0;
    follow_error_16_ = 0;
    gear_.reset();
    coil_.forget();
}

// 001 §3.2.163
void MotionProfile::resynchronise() {
    const std::uint32_t control = state_.control();
    if ((control & state_.bits().man_resync) != 0) {
        const bool relative = (control & state_.bits().rel_resync) != 0;
        const std::int64_t p_new = memory_.get(cell::P_NEW);
        const auto move = [&](Cell position, std::int64_t by) {
            memory_.set(position, wrap32((relative ? memory_.get(position) : 0) + by));
        };
        move(cell::P_SOLL, p_new);
        move(cell::P_IST, p_new);
        move(cell::P_FNC, p_new * 16);
        state_.set_control(control & ~state_.bits().man_resync);
    }
    if (resynchronises_by_itself()) {
        memory_.set(cell::P_FNC, wrap32(16 * std::int64_t{state_.p_ist()}));
    }
}

bool MotionProfile::resynchronises_by_itself() const {
    const std::uint32_t control = state_.control();
    return (control & state_.bits().auto_resync) != 0 &&
           (state_.is_mode(MotorMode::init) || state_.is_mode(MotorMode::safe));
}

std::int32_t MotionProfile::v_soll() const {
    return std::clamp(memory_.get(cell::V_SOLL), -kBound, kBound);
}

std::int32_t MotionProfile::acceleration() const {
    const std::int32_t normal = magnitude(memory_.get(cell::A_SOLL));
    if (!state_.is_mode(MotorMode::stop)) return normal;
    const std::int32_t hard = magnitude(memory_.get(cell::ACC_EMERG));
    return std::max(state_.emergency && hard != 0 ? hard : normal, 1);
}

/// Distance to P_SOLL, modulo 2^32 as P_FNC wraps.
std::int64_t MotionProfile::distance_16() const {
    return wrap32(16 * std::int64_t{memory_.get(cell::P_SOLL)} - memory_.get(cell::P_FNC));
}

std::int32_t MotionProfile::torque_limit() const {
    switch (static_cast<MotorMode>(state_.mode())) {
        case MotorMode::stop:
            return kFullTorque;
        case MotorMode::home1:
            return Homing::torque_limit(memory_.get(cell::T_HOME));
        case MotorMode::velocity_analogue_torque:
            return analogue_torque_limit(state_.model(), memory_.get(cell::ANINP), memory_.get(cell::T_SOLL));
        default:
            return memory_.get(cell::T_SOLL);
    }
}

void MotionProfile::run() {
    const auto towards = [&](std::int32_t velocity) {
        regulate(velocity_block(velocity, v_from_, acceleration()));
    };
    switch (state_.facts().block) {
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

/// Deceleration planned for the end of a move.
std::int32_t MotionProfile::braking(std::int64_t distance, std::int32_t acceleration) {
    if (v_from_ == 0 && distance == 0) corrected_braking_ = 0;
    return corrected_braking_ == 0 ? acceleration : std::min(corrected_braking_, acceleration);
}

/// With the position block, to what is `distance` away.
void MotionProfile::run_to(std::int64_t distance) {
    const std::int32_t acceleration = this->acceleration();
    const std::int32_t limit = std::abs(v_soll());
    regulate(position_block(distance, v_from_, limit, acceleration, braking(distance, acceleration)));
}

void MotionProfile::run_position() {
    const std::int64_t distance = distance_16();
    if (distance != distance_to_go_)
        corrected_braking_ = 0;  // a new target: the learned value does not apply to it
    run_to(distance);
    distance_to_go_ = wrap32(distance - v_old_);
}

void MotionProfile::regulate(std::int32_t fnc_out) {
    const Servo::Result out = servo_.carry_out(
        {.kind = Drive::Kind::velocity, .fnc_out = fnc_out, .torque_limit = torque_limit()}, memory_);
    bool thrown_back = false;
    if (state_.facts().corrected) {
        const std::int32_t wanted = fnc_out;
        learn_braking(wanted, out.correction);
        fnc_out = std::clamp(wanted + out.correction, -kBound, kBound);
        thrown_back = out.correction != 0 && std::int64_t{wanted} * fnc_out < 0;
    }
    const std::int64_t corrected = state_.facts().corrected ? std::int64_t{memory_.get(cell::FNCERR)} : 0;
    memory_.set(cell::FNCERR, state_.facts().corrected ? wrap32(corrected + out.correction) : 0);
    follow_error_16_ += fnc_out - 16 * state_.v_ist();
    memory_.set(cell::FLWERR, state_.is_mode(MotorMode::stop) ? 0 : wrap32(follow_error_16_ / 16));
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + fnc_out));
    show_profile(fnc_out);
    go_on_from(fnc_out, thrown_back);
}

// R: a profile that the torque limit has reversed, as at a hard stop, is not limited by A_SOLL on its way
// back: otherwise it would leave the stop and return repeatedly.
void MotionProfile::go_on_from(std::int32_t fnc_out, bool thrown_back) {
    v_old_ = fnc_out;
    v_from_ = thrown_back ? 0 : fnc_out;
}

// R: a move whose braking had to be corrected is planned with less deceleration to its end, or it would
// oscillate about its target. Gear modes have no such end and move back instead.
void MotionProfile::learn_braking(std::int32_t wanted, std::int32_t correction) {
    if (correction == 0 && state_.facts().geared() && corrected_braking_ != 0) {
        corrected_braking_ += corrected_braking_ / 64 + 1;
        if (corrected_braking_ >= acceleration()) corrected_braking_ = 0;
    }
    if (correction == 0 || std::abs(wanted) >= std::abs(v_from_)) return;
    const std::int32_t before = corrected_braking_ == 0 ? acceleration() : corrected_braking_;
    corrected_braking_ = std::max(before - before / 16 - 1, 1);
}

void MotionProfile::show_profile(std::int32_t fnc_out) {
    const std::uint32_t flags = fnc_out > v_old_ ? err::ACC_FLAG : fnc_out < v_old_ ? err::DEC_FLAG : 0;
    state_.show_error_bits(err::ACC_FLAG | err::DEC_FLAG, flags);
    memory_.set(cell::FNC_OUT, state_.is_mac800() ? wrap32(std::int64_t{fnc_out} * 0x10000) : fnc_out);
}

void MotionProfile::judge_in_position() {
    if (!within_window()) return clear_in_position();
    ++samples_within_;
    if (samples_within_ < memory_.get(cell::INPOSCNT)) return;
    samples_within_ = std::max(memory_.get(cell::INPOSCNT), 0);
    state_.set_error_bits(err::IN_POS, true);
}

// 001 §4.1.1 for velocity mode (R: the text has three versions), §4.4.3 for position mode, §4.4.4 for the
// gear modes (R: P_FNC there is the block's own G_FNC).
bool MotionProfile::within_window() const {
    const std::int64_t window = memory_.get(cell::INPOSWIN);
    switch (state_.facts().in_position) {
        case ModeFacts::InPosition::never:
            return false;
        case ModeFacts::InPosition::position:
            return std::abs(distance_16() + follow_error_16_) < 16 * window;
        case ModeFacts::InPosition::gear:
            return std::abs(gear_.g_fnc()) < 16 * window;
        case ModeFacts::InPosition::velocity:
            break;
    }
    if (memory_.get(cell::INPOSCNT) == 0) return std::abs(std::int64_t{state_.v_ist()}) < window;
    return std::abs(std::int64_t{v_soll()} - 16 * std::int64_t{state_.v_ist()}) < window;
}

// R: P_FNC follows the shaft, so that the position is kept after a stop.
void MotionProfile::stay_passive(const Drive& drive) {
    if (!resynchronises_by_itself()) {
        const std::int64_t moved = 16 * std::int64_t{state_.v_ist()} - follow_error_16_;
        memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) + moved));
    }
    follow_error_16_ = 0;
    memory_.set(cell::FLWERR, 0);
    memory_.set(cell::FNCERR, 0);
    go_on_from(0, false);
    servo_.carry_out(drive, memory_);
    show_profile(0);
    clear_in_position();
}

void MotionProfile::begin_mode(const ModeFacts& next) {
    corrected_braking_ = 0;
    v_from_ = v_old_;
    clear_in_position();
    if (next.corrected) begin_correction();
    if (next.geared()) gear_.reset();
}

// One sample ahead, as in every sample.
void MotionProfile::begin_at_measured_speed() {
    // A user may have written V_IST.
    go_on_from(16 * std::clamp(state_.v_ist(), -kBound, kBound), false);
    follow_error_16_ = v_old_;
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + v_old_));
    servo_.restart(v_old_);
}

// R: the lag dropped by the regulator in a mode without correction is subtracted from P_FNC now, so that
// P_FNC - FLWERR stays correct.
void MotionProfile::begin_correction() {
    const std::int64_t given_up = follow_error_16_ - servo_.lag_16();
    memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) - given_up));
    follow_error_16_ = servo_.lag_16();
    memory_.set(cell::FNCERR, 0);
}

// Modes controlled by the analogue input: AV, AVZ, A2POS, APOS (001 §4.1.5, §4.1.6, §4.1.10, §4.1.11).

std::int32_t MotionProfile::analogue_v_soll() const {
    const std::int32_t aninp = memory_.get(cell::ANINP);
    return state_.is_mode(MotorMode::analogue_velocity)
               ? analogue_velocity(state_.model(), aninp, v_soll())
               : analogue_velocity_with_dead_band(state_.model(), aninp, v_soll());
}

void MotionProfile::set_target_by_place() {
    memory_.set(cell::P_SOLL,
                analogue_position(memory_.get(cell::ANINP), memory_.get(cell::P1), memory_.get(cell::P1[1]),
                                  memory_.get(cell::P1[2]), memory_.get(cell::P_SOLL)));
}

// The three ways are those of a P register selected over FastMAC. R: so P_FNC - 16 x P2 in place of the
// text's P_FNC - P2, for P_FNC counts in 1/16.
void MotionProfile::set_target_by_level() {
    if (!inputs_.level_changed()) return;
    select_position(inputs_.level() ? 2 : 1);
}

// The modes that follow pulses: GP, AVG, AG, COIL, GF (001 §4.1.3, §4.1.7, §4.1.9, §4.1.12, §4.4.20).

// R: AVG and AG have the block of Gear Position mode, which 001 §4.4.19 refers to.
void MotionProfile::run_gear() {
    const std::int32_t aninp = memory_.get(cell::ANINP);
    const std::int32_t factor =
        state_.is_mode(MotorMode::analogue_gear) ? analogue_gear_factor(state_.model(), aninp) : Gear::kOne;
    gear_.take(
        gear_.scale(memory_.get(cell::V_EXT), memory_.get(cell::GEARF1), memory_.get(cell::GEARF2), factor));
    if (state_.is_mode(MotorMode::analogue_velocity_gear)) gear_.take(analogue_trim(state_.model(), aninp));
    if (state_.is_mode(MotorMode::gear_follow)) {
        regulate(gear_follow_block(gear_.g_fnc(), v_from_, std::abs(v_soll()), acceleration()));
    } else {
        run_to(-gear_.g_fnc());
    }
    gear_.went(v_old_);
    show_gear_error();
}

Coil::Setup MotionProfile::coil_setup() const {
    const auto p = [&](int n) { return std::int64_t{memory_.get(cell::P1[n - 1])}; };
    return {.left_thread = p(1),
            .left_stop = p(2),
            .right_stop = p(3),
            .right_thread = p(4),
            .start = p(5),
            .direction = p(6)};
}

// G_FNC is what P_FNC still has to go to the traverse's place.
void MotionProfile::run_coil() {
    const Coil::Setup setup = coil_setup();
    const std::int64_t travel =
        gear_.scale(memory_.get(cell::V_EXT), memory_.get(cell::GEARF1), memory_.get(cell::GEARF2));
    coil_.step(setup, inputs_.level(), travel);
    const std::int32_t here = memory_.get(cell::P_FNC);
    const std::int64_t distance = wrap32(coil_.target_16(setup, here) - here);
    run_to(distance);
    gear_.stand_at(v_old_ - distance);
    show_gear_error();
}

/// FNCERR is a positioning error here (001 §3.2.24; R: only where the block is corrected).
void MotionProfile::show_gear_error() {
    memory_.set(cell::G_FNC, wrap32(gear_.g_fnc()));
    if (state_.facts().corrected) memory_.set(cell::FNCERR, wrap32(gear_.g_fnc()));
}

void MotionProfile::begin_homing(Homing::Method method) {
    homing_.begin(method);
    memory_.set(cell::FNCERR, 0);
}

// R: homing has its own velocity and torque: V_SOLL and T_SOLL keep theirs, so a V_SOLL = 0 does not stop it.
bool MotionProfile::search_home() {
    return homing_.step({.v_home = std::clamp(memory_.get(cell::V_HOME), -kBound, kBound),
                         .t_home = std::clamp(memory_.get(cell::T_HOME), -kBound, kBound),
                         .torque = servo_.torque(),
                         .sensor = inputs_.level()});
}

// R: from the velocity measured, without follow error, or P_IST and P_FNC would not agree.
void MotionProfile::take_position(std::int32_t position) {
    memory_.set(cell::P_IST, position);
    memory_.set(cell::P_FNC, wrap32(16 * std::int64_t{position}));
    memory_.set(cell::P_SOLL, 0);
    corrected_braking_ = 0;
    coil_.forget();
    go_on_from(16 * state_.v_ist(), false);
    follow_error_16_ = v_old_;  // as the regulator's, for this sample's V_IST is counted in P_IST already
    servo_.restart(v_old_);
}

// 001 §3.2.35 bits 9 and 10. R: P_FNC wins if both are set.
void MotionProfile::select_position(int index) {
    const auto flags = static_cast<std::uint32_t>(
        memory_.get(state_.bits().relpos_in_cntrl_bits ? cell::CNTRL_BITS : cell::ERR_STAT));
    const std::int64_t position = memory_.get(cell::P1[index - 1]);
    if ((flags & state_.bits().relpos_p_fnc) != 0) {
        memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) - 16 * position));
    } else if ((flags & state_.bits().relpos_p_soll) != 0) {
        memory_.set(cell::P_SOLL, wrap32(memory_.get(cell::P_SOLL) + position));
    } else {
        memory_.set(cell::P_SOLL, wrap32(position));
    }
    clear_in_position();
}

}  // namespace nplc::sim
