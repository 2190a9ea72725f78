#include "sim/motor_inputs.h"

#include <algorithm>
#include <cstdlib>

#include "sim/motor_memory.h"
#include "sim/profile_blocks.h"

namespace nplc::sim {

void PulseInput::configure(registers::Model model, std::int32_t cntrl_bits, std::int32_t hw_setup) {
    constexpr std::int32_t kUserInterface = 3, kPulsesIn = 0, kPulseDir = 4, kInpSign = 8, kHiClk = 0x10;
    constexpr std::int32_t kXPrInp = 0x10, kNoFilt = 0x20, kInvXDir = 0x40;
    const bool big = is_mac800(model);
    const auto set = [&](std::int32_t small_bit, std::int32_t big_bit) {
        return big ? (hw_setup & big_bit) != 0 : (cntrl_bits & small_bit) != 0;
    };
    on_ = big || (cntrl_bits & kUserInterface) == kPulsesIn;
    format_ = set(kPulseDir, kXPrInp) ? PulseFormat::pulse_and_direction : PulseFormat::quadrature;
    inverted_ = set(kInpSign, kInvXDir);
    fast_ = set(kHiClk, kNoFilt);
}

bool PulseInput::filters(PulseFormat generator, std::int64_t counts_per_second) const {
    constexpr std::int64_t kFast = 1'000'000, kSlow = 31'000;  // Hz
    const bool four_a_period = generator == PulseFormat::quadrature;
    return std::abs(counts_per_second) / (four_a_period ? 4 : 1) > (fast_ ? kFast : kSlow);
}

int PulseInput::quarters(PulseFormat generator, std::int64_t counts_per_second) const {
    if (!on_ || filters(generator, counts_per_second)) return 0;
    const bool four_a_period = generator == PulseFormat::quadrature;
    const int sign = inverted_ ? -1 : 1;
    if (generator == format_) return 4 * sign;
    return four_a_period ? sign : 0;
}

void Terminals::set_analogue(std::int32_t millivolts) {
    millivolts_ = millivolts;
    sensor_.reset();
}

std::int32_t Terminals::sensed(std::int64_t shaft_counts) const {
    constexpr std::int32_t kOn = 10'000;
    const bool above = shaft_counts > sensor_->counts;
    const bool below = shaft_counts < sensor_->counts;
    return (sensor_->on_above ? above : below) ? kOn : 0;
}

void Terminals::set_pulse_rate(std::int32_t per_second, PulseFormat format) {
    constexpr std::int32_t kFastest = 1'000'000;
    pulse_format_ = format;
    pulse_rate_ = std::clamp(per_second, -kFastest, kFastest);
}

std::int32_t Terminals::pulses(std::chrono::nanoseconds period, const PulseInput& input) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    fraction_ += pulse_rate_ * period.count() * input.quarters(pulse_format_, pulse_rate_) / 4;
    const std::int64_t whole = fraction_ / kSecond;
    fraction_ -= whole * kSecond;
    return static_cast<std::int32_t>(whole);
}

void MotorInputs::power_up() {
    pulse_input_.configure(state_.model(), state_.memory.get(cell::CNTRL_BITS),
                           state_.memory.get(cell::HW_SETUP));
    level_ = AnalogueLevel(state_.model());
    level_was_on_ = false;
}

void MotorInputs::read(std::int64_t counts) {
    MotorMemory& memory = state_.memory;
    const std::int32_t voltage = voltage_.of(state_.model(), terminals.millivolts(counts));
    memory.set(cell::ANINP, wrap32(std::int64_t{voltage} + memory.get(cell::ANINP_OFFSET)));
    level_was_on_ = level_.on();
    level_.update(memory.get(cell::ANINP));
    if (state_.is_mac800()) {
        memory.set(cell::DEGC, memory.get(cell::DEGC) + surroundings.degc());
        memory.set(cell::U_24V, surroundings.u_24v());
    }

    const std::int32_t pulses = terminals.next_pulses(state_.sample_period(), pulse_input_);
    if (!state_.facts().counts_pulses) return;
    const std::int64_t turned = state_.is_mode(MotorMode::coil) ? memory.get(cell::V1[7]) : 0;  // 001 §4.4.20
    memory.set(cell::V_EXT, wrap32(pulses + turned));
}

}  // namespace nplc::sim
