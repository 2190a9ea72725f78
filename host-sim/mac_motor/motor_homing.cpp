#include <algorithm>

#include "sim/mac_motor.h"

namespace nplc::sim {

void MacMotor::begin_homing() {
    using enum Homing::Method;
    homing_.begin(is_mode(MotorMode::home1) ? torque : is_mode(MotorMode::home2) ? sensor_on : sensor_left);
    memory_.set(cell::FNCERR, 0);
    set_home_done(false);
}

// R: homing has its own velocity and torque: V_SOLL and T_SOLL keep theirs, so a V_SOLL = 0 does not stop it.
void MacMotor::search_home() {
    constexpr std::int32_t kBound = 0xFFFF;  // MAC800 registers hold more
    const bool found = homing_.step({.v_home = std::clamp(memory_.get(cell::V_HOME), -kBound, kBound),
                                     .t_home = std::clamp(memory_.get(cell::T_HOME), -kBound, kBound),
                                     .torque = servo_.torque(),
                                     .sensor = analogue_level_.on()});
    if (found) end_homing();
}

// 001 §4.4.13. R: the profile begins anew from the velocity measured, without follow error, or P_IST and
// P_FNC would not agree; a STARTMODE that is no mode to be in, or homes again, ends in INIT.
void MacMotor::end_homing() {
    const std::int32_t position = wrap32(std::int64_t{memory_.get(cell::P_HOME)} + beyond_index());
    memory_.set(cell::P_IST, position);
    memory_.set(cell::P_FNC, wrap32(16 * std::int64_t{position}));
    memory_.set(cell::P_SOLL, 0);
    corrected_braking_ = 0;
    coil_.forget();
    go_on_from(16 * v_ist(), false);
    follow_error_16_ = v_old_;  // as the regulator's, for this sample's V_IST is counted in P_IST already
    servo_.restart(v_old_);
    set_home_done(true);

    const auto start_mode = static_cast<std::uint16_t>(memory_.get(cell::STARTMODE));
    const ModeFacts* start = facts_of(start_mode);
    const bool usable = start != nullptr && !start->homing() && start_mode != number(MotorMode::safe);
    request_mode(usable ? start_mode : number(MotorMode::init));
    if (facts().homing()) request_init();
}

/// INDEX_HOME: counts that the shaft is beyond the nearest index marker, else 0 (001 §3.2.36). R: markers are
/// where the encoder counted from when the motor was built, two a revolution, one on MAC800.
std::int32_t MacMotor::beyond_index() const {
    if ((static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS)) & bits().index_home) == 0) return 0;
    const std::int64_t pitch = bits().counts_to_index;
    const std::int64_t beyond = ((servo_.counts() % pitch) + pitch) % pitch;
    return static_cast<std::int32_t>(2 * beyond < pitch ? beyond : beyond - pitch);
}

/// MAC800's HOME_MODE bit 16.
void MacMotor::set_home_done(bool done) {
    const auto home_mode = static_cast<std::uint32_t>(memory_.get(cell::HOME_MODE));
    memory_.set(cell::HOME_MODE, static_cast<std::int32_t>(done ? home_mode | bits().home_done
                                                                : home_mode & ~bits().home_done));
}

}  // namespace nplc::sim
