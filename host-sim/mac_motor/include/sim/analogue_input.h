#pragma once

#include <algorithm>
#include <cstdint>

#include "sim/motor_memory.h"

namespace nplc::sim {

/// ANINP at 10 V.
constexpr std::int32_t analogue_full_scale(registers::Model model) {
    return is_mac800(model) ? 2048 : 1023;
}

/// Millivolts as ANINP has them before ANINP_OFFSET: 10 V are 1023 (001 §3.2.122), on MAC800 2048 (004).
/// What is beyond +/- 10 V reads as 10 V.
constexpr std::int32_t analogue_register(registers::Model model, std::int32_t millivolts) {
    constexpr std::int32_t kFullScale = 10'000;  // mV
    return std::clamp(millivolts, -kFullScale, kFullScale) * analogue_full_scale(model) / kFullScale;
}

/// The same for a voltage that hardly ever changes.
class AnalogueVoltage {
  public:
    std::int32_t of(registers::Model model, std::int32_t millivolts) {
        if (millivolts != millivolts_) {
            millivolts_ = millivolts;
            register_ = analogue_register(model, millivolts);
        }
        return register_;
    }

  private:
    std::int32_t millivolts_ = 0;
    std::int32_t register_ = 0;
};

/// The analogue input as a logic level: on above 5.4 V, off below 4.4 V (001 §4.1.10; R: in homing too).
class AnalogueLevel {
  public:
    explicit AnalogueLevel(registers::Model model)
        : above_(analogue_register(model, 5'400)), below_(analogue_register(model, 4'400)) {}

    /// `aninp`: with ANINP_OFFSET.
    bool update(std::int32_t aninp) {
        if (aninp > above_) on_ = true;
        if (aninp <= below_) on_ = false;
        return on_;
    }
    bool on() const { return on_; }

  private:
    std::int32_t above_;  // no register value lies between a limit and the whole number below it
    std::int32_t below_;
    bool on_ = false;
};

}  // namespace nplc::sim
