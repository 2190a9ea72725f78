// The modes without speed regulator: AT's drive, MANI, TESTU, TESTA, BREAK, TESTKI (001 §4.4.5, §4.4.8 to
// §4.4.11, §4.4.23).
#include <algorithm>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

constexpr int kTestSamples = 11;
constexpr std::int32_t kNominalGain = 256;  // KIA, KIB, KIC (001 §3.2.148): ours are exact

}  // namespace

/// What 001 §4.4.9 and §4.4.10 set up before the first sample.
void MacMotor::begin_test() {
    test_samples_ = 0;
    brake_direction_ = v_ist() > 0 ? 1 : v_ist() < 0 ? -1 : 0;
    const bool voltage = is_mode(MotorMode::test_voltage);
    if (!voltage && !is_mode(MotorMode::test_acceleration)) return;
    const Cell first = voltage ? cell::UA_VAL : cell::T_SOLL;
    const Cell second = voltage ? cell::IA_IST[2] : cell::V_IST;
    memory_.set(cell::SAMPLE1[0], is_mac800(model()) ? first.big : first.small);
    memory_.set(cell::SAMPLE1[1], is_mac800(model()) ? second.big : second.small);
    auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    control = (control & ~bits().record_inner) | bits().rewind;
    control |= voltage ? bits().record_inner : bits().record;  // TESTU: with the voltage
    memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(control));
}

Drive MacMotor::test_drive() const {
    const std::int32_t t_soll = std::clamp(memory_.get(cell::T_SOLL), 0, 1023);
    switch (static_cast<MotorMode>(mode())) {
        case MotorMode::analogue_torque:
            if (coasting_) return {.kind = Drive::Kind::torque};
            return {.kind = Drive::Kind::analogue_torque, .torque_limit = t_soll};
        case MotorMode::test_acceleration:
            return {.kind = Drive::Kind::torque, .torque = t_soll};
        case MotorMode::brake:  // R: T_SOLL keeps its value, its torque turns against the motion
            return {.kind = Drive::Kind::torque, .torque = -brake_direction_ * t_soll};
        default:
            return {.kind = facts().drive};
    }
}

void MacMotor::set_recording(bool on) {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS)) & ~bits().record;
    memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(on ? control | bits().record : control));
}

/// R: braked is what stands or has turned round.
bool MacMotor::is_braked() const {
    return std::int64_t{v_ist()} * brake_direction_ <= 0;
}

void MacMotor::end_test() {
    switch (static_cast<MotorMode>(mode())) {
        case MotorMode::test_voltage:  // on in the next sample, for 11 of the inner loop
            if (test_samples_++ == 0) return set_recording(true);
            set_recording(false);
            return set_mode(number(MotorMode::init));
        case MotorMode::test_acceleration:
            if (test_samples_++ < kTestSamples) return;
            set_recording(false);
            return enter(number(MotorMode::brake));
        case MotorMode::brake:
            if (is_braked()) set_mode(number(MotorMode::init));
            return;
        case MotorMode::test_current:  // R: measured, and done
            for (int phase = 0; phase < (is_mac800(model()) ? 2 : 3); ++phase) {
                memory_.set(cell::KIA[phase], kNominalGain);
            }
            return set_mode(number(MotorMode::init));
        default:
            return;
    }
}

}  // namespace nplc::sim
