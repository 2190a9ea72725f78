#include "sim/mode_control.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr int kTestSamples = 11;
constexpr std::int32_t kNominalGain = 256;  // KIA, KIB, KIC (001 §3.2.148): the virtual motor's are exact

}  // namespace

using Leave = ModeFacts::Leave;

void ModeControl::power_up() {
    set_home_done(false);
    state_.emergency = false;
    mode_after_stop_ = 0;
    coasting_ = false;
    note_ = {};
}

/// INIT is not left with an error (001 §4.4.1), nor the STOP that leads to it. R: an error's STOP runs to its
/// end, even if the error is reset meanwhile.
bool ModeControl::error_keeps_mode() const {
    if (state_.is_mode(MotorMode::stop) && state_.emergency) return true;
    return (state_.is_mode(MotorMode::stop) || state_.is_mode(MotorMode::init)) &&
           (state_.error_status() & state_.bits().keeps_init) != 0;
}

void ModeControl::request_mode(std::uint16_t mode) {
    if (state_.is_mode(MotorMode::safe) || mode == number(MotorMode::safe) || facts_of(mode) == nullptr)
        return;
    if (mode == number(MotorMode::init)) return request_init();
    if (!error_keeps_mode()) leave_for(mode);
}

// R: AT and the tests end in INIT whichever mode was requested, and a test runs to its end.
void ModeControl::leave_for(std::uint16_t mode) {
    if (state_.facts().leave == Leave::test) return;
    if (state_.facts().leave == Leave::coasting) {
        if (mode != state_.mode()) coasting_ = true;
        return;
    }
    if (mode == number(MotorMode::stop)) return begin_stop(number(MotorMode::init), false);
    if (facts_of(mode)->begins_at_rest && state_.facts().driven()) return begin_stop(mode, false);
    enter(mode);
}

void ModeControl::request_init() {
    note_ = {};
    go_passive(false);
}

void ModeControl::go_passive(bool emergency) {
    switch (state_.facts().leave) {
        case Leave::at_once:
            if (!state_.is_mode(MotorMode::safe)) state_.set_mode(number(MotorMode::init));
            return;
        case Leave::coasting:
            coasting_ = true;
            return;
        case Leave::test:
            set_recording(false);
            profile_.begin_at_measured_speed();
            return begin_stop(number(MotorMode::init), emergency);
        case Leave::stopping:
            return begin_stop(number(MotorMode::init),
                              emergency || (state_.is_mode(MotorMode::stop) && state_.emergency));
    }
}

void ModeControl::enter(std::uint16_t mode) {
    const ModeFacts& next = *facts_of(mode);
    if (mode != state_.mode()) {
        coasting_ = false;
        profile_.begin_mode(next);
    }
    note_ = why_it_stands(mode);
    state_.set_mode(mode);
    if (next.homing()) begin_homing();
    begin_test();
}

std::string_view ModeControl::why_it_stands(std::uint16_t mode) const {
    if (mode == number(MotorMode::test_torque)) {
        return "the manual does not say what TESTTQ_MODE (23) does: the motor is passive in it as in INIT";
    }
    if (facts_of(mode)->geared() && !inputs_.pulse_input().on()) {
        return "a gear mode finds no pulses: the FastMAC line has the pins of the pulse input (CNTRL_BITS, "
               "USERINTF = 11), V_EXT stays 0; use a MAC800";
    }
    return {};
}

void ModeControl::end_stop_or_test() {
    if (state_.is_mode(MotorMode::stop) && below_300_rpm()) {
        enter(mode_after_stop_);
    } else if (coasting_ && below_300_rpm()) {
        coasting_ = false;
        state_.set_mode(number(MotorMode::init));
    } else if (!state_.facts().driven()) {
        end_test();
    }
}

void ModeControl::request_home() {
    const auto mode = static_cast<std::uint16_t>((memory_.get(cell::HOME_MODE) >> 8) & 0xFF);
    const ModeFacts* wanted = facts_of(mode);
    if (wanted != nullptr && wanted->homing()) request_mode(mode);
}

void ModeControl::begin_stop(std::uint16_t then, bool emergency) {
    mode_after_stop_ = then;
    state_.emergency = emergency;
    profile_.begin_stop();
    state_.set_mode(number(MotorMode::stop));
}

// 001 §4.1.8: measured, so 39 counts/sample is the last that is below on MAC50-141.
bool ModeControl::below_300_rpm() const {
    return state_.speed() < state_.speed_at(300);
}

/// Every error of the monitoring ends in INIT, through STOP where the motor may be turning.
void ModeControl::fail(std::uint32_t error) {
    state_.set_error_bits(error, true);
    go_passive(true);
}

// The modes without speed regulator: AT's drive, MANI, TESTU, TESTA, BREAK, TESTKI (001 §4.4.5, §4.4.8 to
// §4.4.11, §4.4.23).

/// Preparations of 001 §4.4.9 and §4.4.10 before the first sample.
void ModeControl::begin_test() {
    test_samples_ = 0;
    brake_direction_ = state_.v_ist() > 0 ? 1 : state_.v_ist() < 0 ? -1 : 0;
    const bool voltage = state_.is_mode(MotorMode::test_voltage);
    if (!voltage && !state_.is_mode(MotorMode::test_acceleration)) return;
    const Cell first = voltage ? cell::UA_VAL : cell::T_SOLL;
    const Cell second = voltage ? cell::IA_IST[2] : cell::V_IST;
    memory_.set(cell::SAMPLE1[0], state_.is_mac800() ? first.big : first.small);
    memory_.set(cell::SAMPLE1[1], state_.is_mac800() ? second.big : second.small);
    auto control = state_.control();
    control = (control & ~state_.bits().record_inner) | state_.bits().rewind;
    control |= voltage ? state_.bits().record_inner : state_.bits().record;  // TESTU: with the voltage
    state_.set_control(control);
}

Drive ModeControl::test_drive() const {
    const std::int32_t t_soll = std::clamp(memory_.get(cell::T_SOLL), 0, 1023);
    switch (static_cast<MotorMode>(state_.mode())) {
        case MotorMode::analogue_torque:
            if (coasting_) return {.kind = Drive::Kind::torque};
            return {.kind = Drive::Kind::analogue_torque, .torque_limit = t_soll};
        case MotorMode::test_acceleration:
            return {.kind = Drive::Kind::torque, .torque = t_soll};
        case MotorMode::brake:  // R: T_SOLL keeps its value, its torque acts against the motion
            return {.kind = Drive::Kind::torque, .torque = -brake_direction_ * t_soll};
        default:
            return {.kind = state_.facts().drive};
    }
}

void ModeControl::set_recording(bool on) {
    const std::uint32_t control = state_.control() & ~state_.bits().record;
    state_.set_control(on ? control | state_.bits().record : control);
}

/// R: braking ends at standstill or reversal.
bool ModeControl::is_braked() const {
    return std::int64_t{state_.v_ist()} * brake_direction_ <= 0;
}

void ModeControl::end_test() {
    switch (static_cast<MotorMode>(state_.mode())) {
        case MotorMode::test_voltage:  // on in the next sample, for 11 of the inner loop
            if (test_samples_++ == 0) return set_recording(true);
            set_recording(false);
            return state_.set_mode(number(MotorMode::init));
        case MotorMode::test_acceleration:
            if (test_samples_++ < kTestSamples) return;
            set_recording(false);
            return enter(number(MotorMode::brake));
        case MotorMode::brake:
            if (is_braked()) state_.set_mode(number(MotorMode::init));
            return;
        case MotorMode::test_current:  // R: measured, and done
            for (int phase = 0; phase < (state_.is_mac800() ? 2 : 3); ++phase) {
                memory_.set(cell::KIA[phase], kNominalGain);
            }
            return state_.set_mode(number(MotorMode::init));
        default:
            return;
    }
}

void ModeControl::begin_homing() {
    using enum Homing::Method;
    profile_.begin_homing(state_.is_mode(MotorMode::home1)   ? torque
                          : state_.is_mode(MotorMode::home2) ? sensor_on
                                                             : sensor_left);
    set_home_done(false);
}

void ModeControl::search_home() {
    if (profile_.search_home()) end_homing();
}

// 001 §4.4.13. R: a STARTMODE that is no valid mode, or a homing mode, ends in INIT.
void ModeControl::end_homing() {
    const std::int32_t position = wrap32(std::int64_t{memory_.get(cell::P_HOME)} + beyond_index());
    profile_.take_position(position);
    set_home_done(true);

    const auto start_mode = static_cast<std::uint16_t>(memory_.get(cell::STARTMODE));
    const ModeFacts* start = facts_of(start_mode);
    const bool usable = start != nullptr && !start->homing() && start_mode != number(MotorMode::safe);
    request_mode(usable ? start_mode : number(MotorMode::init));
    if (state_.facts().homing()) request_init();
}

/// INDEX_HOME: counts that the shaft is beyond the nearest index marker, else 0 (001 §3.2.36). R: markers are
/// where the encoder counted from when the motor was built, two a revolution, one on MAC800.
std::int32_t ModeControl::beyond_index() const {
    if ((state_.control() & state_.bits().index_home) == 0) return 0;
    const std::int64_t pitch = state_.bits().counts_to_index;
    const std::int64_t beyond = ((servo_.counts() % pitch) + pitch) % pitch;
    return static_cast<std::int32_t>(2 * beyond < pitch ? beyond : beyond - pitch);
}

/// MAC800's HOME_MODE bit 16.
void ModeControl::set_home_done(bool done) {
    const auto home_mode = static_cast<std::uint32_t>(memory_.get(cell::HOME_MODE));
    memory_.set(cell::HOME_MODE, static_cast<std::int32_t>(done ? home_mode | state_.bits().home_done
                                                                : home_mode & ~state_.bits().home_done));
}

}  // namespace nplc::sim
