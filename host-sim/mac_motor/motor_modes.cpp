#include <array>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr std::uint16_t kLastMode = 24;
constexpr std::array<std::string_view, kLastMode + 1> kModeNames{
    "INIT",       "V_MODE",      "P_MODE",      "GP_MODE",    "AT_MODE",   "AV_MODE",    "AVG_MODE",
    "MANI_MODE",  "TESTU_MODE",  "TESTA_MODE",  "BREAK_MODE", "STOP_MODE", "HOME1_MODE", "HOME2_MODE",
    "HOME3_MODE", "SAFE_MODE",   "AVZ_MODE",    "VAT_MODE",   "AG_MODE",   "COIL_MODE",  "A2POS_MODE",
    "APOS_MODE",  "TESTKI_MODE", "TESTTQ_MODE", "GF_MODE"};

constexpr std::uint16_t number(MotorMode mode) {
    return static_cast<std::uint16_t>(mode);
}

constexpr bool drives(std::uint16_t mode) {
    return mode == number(MotorMode::velocity) || mode == number(MotorMode::position) ||
           mode == number(MotorMode::stop);
}

std::string passive_note(std::uint16_t mode) {
    return "mode " + std::to_string(mode) + " (" + std::string(kModeNames[mode]) +
           ") is not simulated yet: the motor is passive as in INIT; use modes 0, 1 and 2";
}

}  // namespace

bool MacMotor::is_driven() const {
    return drives(mode());
}

bool MacMotor::error_forbids_motion() const {
    return (error_status() & bits().keeps_init) != 0;
}

void MacMotor::request_mode(std::uint16_t mode) {
    if (is_mode(MotorMode::safe) || mode == number(MotorMode::safe)) {
        if (is_mode(MotorMode::safe)) load_parameters(mode);
        return;
    }
    if (mode > kLastMode) return;
    if (mode == number(MotorMode::init)) {
        unsupported_.clear();
        if (is_mode(MotorMode::stop)) {
            mode_after_stop_ = mode;
        } else if (is_driven()) {
            begin_stop(mode, false);
        } else {
            set_mode(mode);
        }
        return;
    }
    if (error_forbids_motion()) return;
    if (!drives(mode)) {
        unsupported_ = passive_note(mode);
        if (is_driven()) {
            begin_stop(mode, false);
        } else {
            set_mode(mode);
        }
        return;
    }
    unsupported_.clear();
    if (mode == number(MotorMode::stop)) return begin_stop(number(MotorMode::init), false);
    if (mode == number(MotorMode::position) && !is_mode(MotorMode::position)) begin_position_mode();
    set_mode(mode);
}

// 001 §5.2.1.4, command 10h
void MacMotor::request_home() {
    const auto mode = static_cast<std::uint16_t>((memory_.get(cell::HOME_MODE) >> 8) & 0xFF);
    constexpr std::uint16_t kHome1 = 12, kHome3 = 14;
    if (mode >= kHome1 && mode <= kHome3) request_mode(mode);
}

void MacMotor::begin_stop(std::uint16_t then, bool emergency) {
    mode_after_stop_ = then;
    emergency_ = emergency;
    set_mode(number(MotorMode::stop));
}

// R: what the regulator gave up in a mode without correction is taken off P_FNC now: P_FNC - FLWERR stays
// true.
void MacMotor::begin_position_mode() {
    const std::int64_t given_up = follow_error_16_ - regulator_.lag_16();
    memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) - given_up));
    follow_error_16_ = regulator_.lag_16();
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
