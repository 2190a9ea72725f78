#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "macreg/finding.h"
#include "macreg/motor.h"

/// Why does it not move? (001 §4.4, §4.5, 004)
namespace nplc::macreg {

/// Of the gateway between us and the motor.
struct GatewayState {
    std::uint32_t status = 0;       ///< its STATUS
    std::uint32_t safe_reason = 0;  ///< its SAFE_REASON
};

/// What `why` judges: the same registers twice, some time apart.
struct Condition {
    registers::Model model = registers::Model::mac140;
    Snapshot before{};
    Snapshot now{};
    std::optional<GatewayState> gateway{};
};

/// Reads twice, 200 ms apart. `look_for_gateway`: also asks whether the motor is behind one.
Condition read_condition(Motor& motor, bool look_for_gateway = true);

/// What keeps the motor from moving, what to mend first in front. Pure; never empty: the last resort is
/// "unknown", with what was looked at. A motor that moves is told as "moves".
std::vector<Finding> why(const Condition& condition);

}  // namespace nplc::macreg
