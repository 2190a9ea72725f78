// Switching of modes (001 §4.4, §5.2.1.4 command 10h). What a mode is, and how it is left, is in mode_table.
#include <algorithm>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr std::int32_t kMostCounts = 0xFFFF;

}  // namespace

using Leave = ModeFacts::Leave;

/// INIT is not left with an error (001 §4.4.1), nor the STOP that leads to it. R: an error's STOP runs to its
/// end, even if the error is reset meanwhile.
bool MacMotor::error_keeps_mode() const {
    if (is_mode(MotorMode::stop) && emergency_) return true;
    return (is_mode(MotorMode::stop) || is_mode(MotorMode::init)) &&
           (error_status() & bits().keeps_init) != 0;
}

void MacMotor::request_mode(std::uint16_t mode) {
    if (is_mode(MotorMode::safe) || mode == number(MotorMode::safe)) {
        if (is_mode(MotorMode::safe)) load_parameters(mode);
        return;
    }
    if (facts_of(mode) == nullptr) return;
    if (mode == number(MotorMode::init)) return request_init();
    if (!error_keeps_mode()) leave_for(mode);
}

// R: AT and the tests end in INIT whatever they are left for, and a test runs to its end.
void MacMotor::leave_for(std::uint16_t mode) {
    if (facts().leave == Leave::test) return;
    if (facts().leave == Leave::coasting) {
        if (mode != this->mode()) coasting_ = true;
        return;
    }
    if (mode == number(MotorMode::stop)) return begin_stop(number(MotorMode::init), false);
    if (facts_of(mode)->begins_at_rest && is_driven()) return begin_stop(mode, false);
    enter(mode);
}

void MacMotor::request_init() {
    note_ = {};
    go_passive(false);
}

/// 001 §4.1.8, §4.4.1: to INIT as the mode allows it.
void MacMotor::go_passive(bool emergency) {
    switch (facts().leave) {
        case Leave::at_once:
            if (!is_mode(MotorMode::safe)) set_mode(number(MotorMode::init));
            return;
        case Leave::coasting:
            coasting_ = true;
            return;
        case Leave::test:
            set_recording(false);
            begin_at_measured_speed();
            return begin_stop(number(MotorMode::init), emergency);
        case Leave::stopping:
            return begin_stop(number(MotorMode::init), emergency || (is_mode(MotorMode::stop) && emergency_));
    }
}

void MacMotor::enter(std::uint16_t mode) {
    const ModeFacts& next = *facts_of(mode);
    if (mode != this->mode()) {
        corrected_braking_ = 0;
        coasting_ = false;
        v_from_ = v_old_;
        clear_in_position();
        if (next.corrected) begin_correction();
        if (next.geared()) gear_.reset();
    }
    note_ = why_it_stands(mode);
    set_mode(mode);
    if (next.homing()) begin_homing();
    begin_test();
}

std::string_view MacMotor::why_it_stands(std::uint16_t mode) const {
    if (mode == number(MotorMode::test_torque)) {
        return "the manual does not say what TESTTQ_MODE (23) does: the motor is passive in it as in INIT";
    }
    if (facts_of(mode)->geared() && !pulse_input_.on()) {
        return "a gear mode finds no pulses: the FastMAC line has the pins of the pulse input (CNTRL_BITS, "
               "USERINTF = 11), V_EXT stays 0; use a MAC800";
    }
    return {};
}

void MacMotor::end_stop_or_test() {
    if (is_mode(MotorMode::stop) && below_300_rpm()) {
        enter(mode_after_stop_);
    } else if (coasting_ && below_300_rpm()) {
        coasting_ = false;
        set_mode(number(MotorMode::init));
    } else if (!is_driven()) {
        end_test();
    }
}

void MacMotor::request_home() {
    const auto mode = static_cast<std::uint16_t>((memory_.get(cell::HOME_MODE) >> 8) & 0xFF);
    const ModeFacts* wanted = facts_of(mode);
    if (wanted != nullptr && wanted->homing()) request_mode(mode);
}

void MacMotor::begin_stop(std::uint16_t then, bool emergency) {
    mode_after_stop_ = then;
    emergency_ = emergency;
    v_from_ = v_old_;
    set_mode(number(MotorMode::stop));
}

/// Out of a mode without speed regulator: the profile begins where the shaft is and as fast as it is, a
/// sample ahead as always.
void MacMotor::begin_at_measured_speed() {
    // A user may have written V_IST.
    go_on_from(16 * std::clamp(v_ist(), -kMostCounts, kMostCounts), false);
    follow_error_16_ = v_old_;
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + v_old_));
    servo_.restart(v_old_);
}

// R: what the regulator gave up in a mode without correction is taken off P_FNC now: P_FNC - FLWERR stays
// true.
void MacMotor::begin_correction() {
    const std::int64_t given_up = follow_error_16_ - servo_.lag_16();
    memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) - given_up));
    follow_error_16_ = servo_.lag_16();
    memory_.set(cell::FNCERR, 0);
}

// 001 §4.1.8: measured, so 39 counts/sample is the last that is below on MAC50-141.
bool MacMotor::below_300_rpm() const {
    constexpr std::int64_t kNanosecondsInMinute = 60'000'000'000;
    const std::int64_t v = v_ist();
    return (v < 0 ? -v : v) * kNanosecondsInMinute <
           300 * std::int64_t{counts_per_revolution()} * sample_period().count();
}

}  // namespace nplc::sim
