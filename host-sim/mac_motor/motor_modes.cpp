#include <string>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

std::string passive_note(std::uint16_t mode, std::string_view name) {
    return "mode " + std::to_string(mode) + " (" + std::string(name) +
           ") is not simulated yet: the motor is passive as in INIT; use modes 0 to 3, 12 to 14 or 24";
}

std::string no_pulses_note(std::uint16_t mode, std::string_view name) {
    return "mode " + std::to_string(mode) + " (" + std::string(name) +
           ") finds no pulses: the FastMAC line has the pins of the pulse input (CNTRL_BITS, USERINTF = 11), "
           "V_EXT stays 0; use a MAC800";
}

}  // namespace

const ModeFacts& MacMotor::facts() const {
    return *facts_of(mode());
}

bool MacMotor::error_forbids_motion() const {
    return (error_status() & bits().keeps_init) != 0;
}

void MacMotor::request_mode(std::uint16_t mode) {
    if (is_mode(MotorMode::safe) || mode == number(MotorMode::safe)) {
        if (is_mode(MotorMode::safe)) load_parameters(mode);
        return;
    }
    const ModeFacts* wanted = facts_of(mode);
    if (wanted == nullptr) return;
    if (mode == number(MotorMode::init)) return request_init();
    if (error_forbids_motion()) return;
    unsupported_.clear();
    if (!wanted->simulated) unsupported_ = passive_note(mode, wanted->name);
    if (!wanted->driven && is_driven()) return begin_stop(mode, false);
    if (mode == number(MotorMode::stop)) return begin_stop(number(MotorMode::init), false);
    enter(mode);
}

void MacMotor::request_init() {
    unsupported_.clear();
    if (is_mode(MotorMode::stop)) {
        mode_after_stop_ = number(MotorMode::init);
    } else if (is_driven()) {
        begin_stop(number(MotorMode::init), false);
    } else {
        set_mode(number(MotorMode::init));
    }
}

void MacMotor::enter(std::uint16_t mode) {
    const ModeFacts& next = *facts_of(mode);
    if (next.corrected && mode != this->mode()) begin_correction();
    if (next.corrected && next.counts_pulses) {
        if (mode != this->mode()) gear_.reset();
        if (!pulse_input_on_) unsupported_ = no_pulses_note(mode, next.name);
    }
    set_mode(mode);
    if (next.homing) begin_homing();
}

// 001 §5.2.1.4, command 10h
void MacMotor::request_home() {
    const auto mode = static_cast<std::uint16_t>((memory_.get(cell::HOME_MODE) >> 8) & 0xFF);
    const ModeFacts* wanted = facts_of(mode);
    if (wanted != nullptr && wanted->homing) request_mode(mode);
}

void MacMotor::begin_stop(std::uint16_t then, bool emergency) {
    mode_after_stop_ = then;
    emergency_ = emergency;
    set_mode(number(MotorMode::stop));
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

// 001 §4.5. I2T and UIT are compared with their limits; nothing computes them yet.
void MacMotor::monitor() {
    const auto beyond = [&](Cell value, Cell limit) {
        const std::int64_t v = memory_.get(value);
        const std::int64_t most = memory_.get(limit);
        return most > 0 && (v < 0 ? -v : v) > most;
    };
    if (beyond(cell::I2T, cell::I2TLIM)) fail(err::I2T_ERR);
    if (beyond(cell::UIT, cell::UITLIM)) fail(err::UIT_ERR);
    if (beyond(cell::FLWERR, cell::FLWERRMAX)) fail(err::FLW_ERR);
    if (beyond(cell::FNCERR, cell::FNCERRMAX)) fail(err::FNC_ERR);
    const std::int32_t low = memory_.get(cell::MIN_P_IST);
    const std::int32_t high = memory_.get(cell::MAX_P_IST);
    const bool limited = (low != 0 || high != 0) && (error_status() & err::DIS_P_LIM) == 0;
    if (limited && (p_ist() < low || p_ist() > high)) fail(err::PLIM_ERR);
}

void MacMotor::fail(std::uint32_t error) {
    set_error_bits(error, true);
    if (is_mode(MotorMode::stop)) {
        mode_after_stop_ = number(MotorMode::init);
        emergency_ = true;
    } else if (is_driven()) {
        begin_stop(number(MotorMode::init), true);
    } else if (!is_mode(MotorMode::safe)) {
        set_mode(number(MotorMode::init));
    }
}

}  // namespace nplc::sim
