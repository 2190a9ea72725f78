#include "sim/mac_motor.h"

#include <algorithm>
#include <cstdlib>

namespace nplc::sim {
namespace {

constexpr std::int32_t kFullTorque = 1023;
constexpr std::int32_t kBound =
    0xFFFF;  // of velocities and accelerations in 1/16: MAC800 registers hold more
constexpr std::size_t kHistory = 16;

/// Of the bare motor at full torque, 1/16 counts/sample^2; ours: 869,000 rpm/s, and 695,000 rpm/s on MAC800.
constexpr std::int32_t full_acceleration_16(registers::Model model) {
    return is_mac800(model) ? 2500 : 3500;
}

std::int32_t magnitude(std::int32_t value) {
    return static_cast<std::int32_t>(std::min<std::int64_t>(std::abs(std::int64_t{value}), kBound));
}

protocol::fastmac::RegisterCode code_of(const MacMotorOptions& options) {
    using protocol::fastmac::RegisterCode;
    return options.old_register_codes ? RegisterCode::older_example : RegisterCode::format_list;
}

}  // namespace

MacMotor::MacMotor(registers::Model model, const MacMotorOptions& options)
    : options_(options),
      memory_(model),
      stored_(model),
      plant_(full_acceleration_16(model), options.load),
      regulator_(full_acceleration_16(model)),
      link_(
          {.model = model, .baud = options.baud, .code = code_of(options), .log_limit = options.order_limit}),
      mactalk_(model) {
    write_defaults(stored_, options.address);
    power_cycle();
}

void MacMotor::power_cycle() {
    constexpr std::int32_t kUserInterfaceBits = 3;
    memory_ = stored_;
    for (const Cell& volatile_cell :
         {cell::P_SOLL, cell::P_FNC, cell::P_IST, cell::V_IST, cell::FLWERR, cell::FNCERR, cell::FNC_OUT,
          cell::VF_OUT, cell::MODE_REG, cell::I2T, cell::UIT}) {
        memory_.set(volatile_cell, 0);
    }
    constexpr std::uint32_t kKept = err::DIS_P_LIM;
    set_error_bits(~(kKept | bits().relpos_p_soll | bits().relpos_p_fnc), false);
    link_on_ =
        is_mac800(model()) || (memory_.get(cell::CNTRL_BITS) & kUserInterfaceBits) == kUserInterfaceBits;
    link_.power_up();
    mactalk_.power_up();
    samples_.rewind();
    samples_.clear();
    last_counts_ = plant_.counts();
    v_history_.clear();
    torque_ = v_old_ = samples_within_ = corrected_braking_ = 0;
    follow_error_16_ = 0;
    emergency_ = false;
    mode_after_stop_ = 0;
    regulator_.reset();
    unsupported_.clear();
    const auto home = static_cast<std::uint16_t>(memory_.get(cell::HOME_MODE) & 0xFF);
    request_mode(home != 0 ? home : static_cast<std::uint16_t>(memory_.get(cell::STARTMODE)));
}

std::int32_t MacMotor::counts_per_revolution() const {
    return is_mac800(model()) ? 8000 : 4096;
}

std::chrono::nanoseconds MacMotor::sample_period() const {
    return std::chrono::nanoseconds(is_mac800(model()) ? 1'298'701 : 1'920'000);
}

double MacMotor::rpm() const {
    return 60e9 * v_ist() / (static_cast<double>(sample_period().count()) * counts_per_revolution());
}

void MacMotor::receive(std::uint8_t byte, bool framing_error, base::Instant now) {
    if (link_on_) link_.receive(byte, framing_error, now, *this);
}

std::optional<std::uint8_t> MacMotor::transmit(base::Instant now) {
    if (!link_on_) return std::nullopt;
    return link_.transmit(now, *this);
}

std::uint16_t MacMotor::mode() const {
    return static_cast<std::uint16_t>(memory_.get(cell::MODE_REG));
}

void MacMotor::sample() {
    measure();
    resynchronise();
    if (is_mode(MotorMode::stop) && below_300_rpm()) set_mode(mode_after_stop_);
    if (is_driven()) {
        run_profile();
        judge_in_position();
    } else {
        stay_passive();
    }
    monitor();
    run_sample_buffer();
}

void MacMotor::measure() {
    if (is_driven()) {
        plant_.drive(torque_);
    } else {
        plant_.short_circuit();
    }
    const std::int64_t counts = plant_.counts();
    const auto v_ist = static_cast<std::int32_t>(counts - last_counts_);
    last_counts_ = counts;
    memory_.set(cell::V_IST, v_ist);
    memory_.set(cell::P_IST, wrap32(std::int64_t{p_ist()} + v_ist));

    v_history_.push_back(v_ist);
    if (v_history_.size() > kHistory) v_history_.pop_front();
    std::int32_t sum = 0;
    for (const std::int32_t v : v_history_) sum += v;
    memory_.set(cell::V_IST_16, sum);
}

// 001 §3.2.163
void MacMotor::resynchronise() {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    if ((control & bits().man_resync) != 0) {
        const bool relative = (control & bits().rel_resync) != 0;
        const std::int64_t p_new = memory_.get(cell::P_NEW);
        const auto move = [&](Cell position, std::int64_t by) {
            memory_.set(position, wrap32((relative ? memory_.get(position) : 0) + by));
        };
        move(cell::P_SOLL, p_new);
        move(cell::P_IST, p_new);
        move(cell::P_FNC, p_new * 16);
        memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(control & ~bits().man_resync));
    }
    if (!is_driven() && (control & bits().auto_resync) != 0) {
        memory_.set(cell::P_FNC, wrap32(16 * std::int64_t{p_ist()}));
    }
}

// R: P_FNC runs on with the shaft, so that a stop does not cost the motor its position.
void MacMotor::stay_passive() {
    const bool auto_resync =
        (static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS)) & bits().auto_resync) != 0;
    if (!auto_resync) {
        const std::int64_t moved = 16 * std::int64_t{v_ist()} - follow_error_16_;
        memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) + moved));
    }
    follow_error_16_ = 0;
    memory_.set(cell::FLWERR, 0);
    memory_.set(cell::FNCERR, 0);
    v_old_ = torque_ = 0;
    regulator_.reset();
    show_profile(0, 0);
    clear_in_position();
}

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

void MacMotor::run_profile() {
    if (is_mode(MotorMode::position)) {
        if (v_old_ == 0 && distance_16() == 0) corrected_braking_ = 0;
        const std::int32_t braking =
            corrected_braking_ == 0 ? acceleration() : std::min(corrected_braking_, acceleration());
        regulate(position_block(distance_16(), v_old_, std::abs(v_soll()), acceleration(), braking));
    } else {
        regulate(velocity_block(is_mode(MotorMode::stop) ? 0 : v_soll(), v_old_, acceleration()));
    }
}

void MacMotor::regulate(std::int32_t fnc_out) {
    const bool stopping = is_mode(MotorMode::stop);
    const std::int32_t kvout = memory_.get(cell::KVOUT);
    const Regulator::Output out =
        regulator_.step({.fnc_out = fnc_out,
                         .v_ist = v_ist(),
                         .torque_limit = stopping ? kFullTorque : memory_.get(cell::T_SOLL),
                         .kvout_256 = is_mac800(model()) ? kvout >> 8 : kvout});
    if (is_mode(MotorMode::position)) {
        learn_braking(fnc_out, out.correction);
        fnc_out += out.correction;
        memory_.set(cell::FNCERR, wrap32(std::int64_t{memory_.get(cell::FNCERR)} + out.correction));
    }
    follow_error_16_ += fnc_out - 16 * v_ist();
    memory_.set(cell::FLWERR, wrap32(follow_error_16_ / 16));
    memory_.set(cell::P_FNC, wrap32(std::int64_t{memory_.get(cell::P_FNC)} + fnc_out));
    show_profile(fnc_out, out.torque);
    v_old_ = fnc_out;
    torque_ = out.torque;
}

// R: a move whose braking had to be corrected is planned with less of it to its end, or it would swing about
// its target.
void MacMotor::learn_braking(std::int32_t wanted, std::int32_t correction) {
    if (correction == 0 || std::abs(wanted) >= std::abs(v_old_)) return;
    const std::int32_t before = corrected_braking_ == 0 ? acceleration() : corrected_braking_;
    corrected_braking_ = std::max(before - before / 16 - 1, 1);
}

void MacMotor::show_profile(std::int32_t fnc_out, std::int32_t torque) {
    set_error_bits(err::ACC_FLAG, fnc_out > v_old_);
    set_error_bits(err::DEC_FLAG, fnc_out < v_old_);
    memory_.set(cell::FNC_OUT, is_mac800(model()) ? wrap32(std::int64_t{fnc_out} * 0x10000) : fnc_out);
    memory_.set(cell::VF_OUT, torque);
}

void MacMotor::judge_in_position() {
    if (is_mode(MotorMode::stop)) return clear_in_position();
    if (!within_window()) return clear_in_position();
    ++samples_within_;
    if (samples_within_ < memory_.get(cell::INPOSCNT)) return;
    samples_within_ = std::max(memory_.get(cell::INPOSCNT), 0);
    set_error_bits(err::IN_POS, true);
}

// 001 §4.1.1 for velocity mode (R: the text has three versions), §4.4.3 for position mode.
bool MacMotor::within_window() const {
    const std::int64_t window = memory_.get(cell::INPOSWIN);
    if (is_mode(MotorMode::position)) return std::abs(distance_16() + follow_error_16_) < 16 * window;
    if (memory_.get(cell::INPOSCNT) == 0) return std::abs(std::int64_t{v_ist()}) < window;
    return std::abs(std::int64_t{v_soll()} - 16 * std::int64_t{v_ist()}) < window;
}

}  // namespace nplc::sim
