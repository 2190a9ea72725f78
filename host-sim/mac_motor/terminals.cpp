#include "sim/terminals.h"

#include <algorithm>

namespace nplc::sim {

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

}  // namespace nplc::sim
