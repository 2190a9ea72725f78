// What is done over MacTalk only: SAFE_MODE's doors, flash, reset (001 §4.4.16, §5.1) and the sample buffer
// (001 §3.2.36, §3.2.112-116).
#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr std::uint16_t kDefaultsToFlash = 256;
constexpr std::uint16_t kDefaults = 257;
constexpr std::uint16_t kStoredAgain = 258;

/// Not parameters: what the motor itself counts and shows, which no flash brings back.
constexpr Cell kVolatile[] = {cell::P_SOLL, cell::P_FNC,   cell::P_IST,  cell::V_IST,    cell::FLWERR,
                              cell::FNCERR, cell::FNC_OUT, cell::VF_OUT, cell::MODE_REG, cell::I2T,
                              cell::UIT,    cell::V_EXT,   cell::G_FNC,  cell::REC_CNT};

}  // namespace

bool MacMotor::enter_safe_mode() {
    if (!is_mode(MotorMode::init)) return false;
    set_mode(static_cast<std::uint16_t>(MotorMode::safe));
    return true;
}

bool MacMotor::leave_safe_mode() {
    if (!is_mode(MotorMode::safe)) return false;
    set_mode(static_cast<std::uint16_t>(MotorMode::init));
    return true;
}

void MacMotor::go_to_init() {
    if (!leave_safe_mode()) request_mode(static_cast<std::uint16_t>(MotorMode::init));
}

bool MacMotor::write_flash() {
    if (!is_mode(MotorMode::safe)) return false;
    store_registers();
    ++flash_writes_;
    power_cycle();
    return true;
}

bool MacMotor::reset() {
    if (!is_mode(MotorMode::safe) && !is_mode(MotorMode::init)) return false;
    power_cycle();
    return true;
}

void MacMotor::clear_volatile(MotorMemory& memory) {
    for (const Cell& volatile_cell : kVolatile) memory.set(volatile_cell, 0);
}

void MacMotor::store_registers() {
    const std::int32_t version = stored_.get(cell::PROG_VERSION);  // 001 §3.2.1: not to be stored
    stored_ = memory_;
    clear_volatile(stored_);
    stored_.set(cell::PROG_VERSION, version);
    // The bits of ERR_STAT that are settings are kept (001 §3.2.35).
    constexpr std::uint32_t kSettings = err::DIS_P_LIM;
    stored_.set(cell::ERR_STAT, static_cast<std::int32_t>(error_status() & (kSettings | bits().relpos_p_soll |
                                                                            bits().relpos_p_fnc)));
}

// 001 §4.4.16: special values of MODE_REG, in SAFE_MODE only.
void MacMotor::load_parameters(std::uint16_t command) {
    MotorMemory wanted = stored_;
    if (command == kDefaultsToFlash || command == kDefaults) {
        wanted = MotorMemory(model());
        write_defaults(wanted, options_.address);
    }
    if (command == kDefaultsToFlash) {
        stored_ = wanted;
        ++flash_writes_;
        return power_cycle();
    }
    if (command != kDefaults && command != kStoredAgain) return;
    for (const Cell& volatile_cell : kVolatile) wanted.set(volatile_cell, memory_.get(volatile_cell));
    wanted.set(cell::ERR_STAT, memory_.get(cell::ERR_STAT));
    memory_ = wanted;
}

void MacMotor::rewind_or_record(std::uint32_t control) {
    if ((control & bits().rewind) != 0) rewind_samples();
    if ((control & bits().record) != 0 && !records_inner(control)) record();
}

/// R: where there is no inner loop, its samples are those of the outer one.
bool MacMotor::records_inner(std::uint32_t control) const {
    return options_.depth == Servo::Depth::current_loop && (control & bits().record_inner) != 0;
}

void MacMotor::rewind_samples() {
    samples_.rewind();
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(control & ~bits().rewind));
    memory_.set(cell::REC_CNT, 0);
}

void MacMotor::record() {
    samples_.record(sampled_registers());
    memory_.set(cell::REC_CNT, static_cast<std::int32_t>(samples_.count()));
    const bool test_ended = servo_.drive().kind == Drive::Kind::voltage &&  // 001 §4.4.9
                            servo_.test_samples() == Servo::kTestSamples;
    if (!samples_.full() && !test_ended) return;
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(control & ~bits().record));
}

void MacMotor::inner_sample() {
    if ((static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS)) & bits().record) != 0) record();
}

SampleBuffer::Sample MacMotor::sampled_registers() const {
    SampleBuffer::Sample sample{};
    for (int i = 0; i < static_cast<int>(sample.size()); ++i) {
        const auto reg = static_cast<std::uint8_t>(memory_.get(cell::SAMPLE1[i]));
        sample[static_cast<std::size_t>(i)] = memory_.read(reg, is_mac800(model()));
    }
    return sample;
}

// A REWIND that no sample has seen yet counts too, or a quick reader would miss the first samples.
SampleBuffer::Sample MacMotor::next_sample() {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    if ((control & bits().rewind) != 0) rewind_samples();
    const SampleBuffer::Sample sample = samples_.next();
    memory_.set(cell::REC_CNT, static_cast<std::int32_t>(samples_.count()));
    return sample;
}

void MacMotor::receive_mactalk(std::uint8_t byte, bool framing_error) {
    mactalk_.receive(byte, framing_error, *this);
}

std::optional<std::uint8_t> MacMotor::transmit_mactalk() {
    return mactalk_.transmit();
}

}  // namespace nplc::sim
