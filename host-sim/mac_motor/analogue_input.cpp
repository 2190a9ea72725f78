#include "sim/analogue_input.h"

#include <algorithm>

#include "sim/motor_memory.h"

namespace nplc::sim {
namespace {

constexpr std::int32_t kFullScale = 10'000;  // mV

}  // namespace

std::int32_t analogue_full_scale(registers::Model model) {
    return is_mac800(model) ? 2048 : 1023;
}

std::int32_t analogue_register(registers::Model model, std::int32_t millivolts) {
    return std::clamp(millivolts, -kFullScale, kFullScale) * analogue_full_scale(model) / kFullScale;
}

bool AnalogueLevel::update(std::int32_t aninp) {
    constexpr std::int64_t kOn = 5'400, kOff = 4'400;
    const std::int64_t scaled = std::int64_t{aninp} * kFullScale;
    if (scaled > kOn * analogue_full_scale(model_)) on_ = true;
    if (scaled < kOff * analogue_full_scale(model_)) on_ = false;
    return on_;
}

}  // namespace nplc::sim
