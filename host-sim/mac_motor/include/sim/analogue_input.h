#pragma once

#include <cstdint>

#include "registers/mac.h"

namespace nplc::sim {

/// ANINP at 10 V.
std::int32_t analogue_full_scale(registers::Model model);

/// Millivolts as ANINP has them before ANINP_OFFSET: 10 V are 1023 (001 §3.2.122), on MAC800 2048 (004).
/// What is beyond +/- 10 V reads as 10 V.
std::int32_t analogue_register(registers::Model model, std::int32_t millivolts);

/// The analogue input as a logic level: on above 5.4 V, off below 4.4 V (001 §4.1.10; R: in homing too).
class AnalogueLevel {
  public:
    explicit AnalogueLevel(registers::Model model) : model_(model) {}

    /// `aninp`: with ANINP_OFFSET.
    bool update(std::int32_t aninp);
    bool on() const { return on_; }

  private:
    registers::Model model_;
    bool on_ = false;
};

}  // namespace nplc::sim
