#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "causes/finding.h"
#include "causes/modes.h"
#include "causes/snapshot.h"
#include "registers/mac.h"

/// Why does it not move? (001 §4.4, §4.5, 004)
namespace nplc::causes {

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

/// The registers that a condition needs; each once.
std::vector<const registers::Register*> judged(registers::Model model);
/// Those of `before`; the others are not looked at there.
std::vector<const registers::Register*> judged_before(registers::Model model);

/// What keeps the motor from moving, what to mend first in front. Pure; never empty: the last resort is
/// "unknown", with what was looked at. A motor that moves is told as "moves".
std::vector<Finding> why(const Condition& condition);
/// The same where nothing is known of the motor: what the gateway alone tells. May be empty.
std::vector<Finding> why(const GatewayState& gateway);
/// "moves", of a motor whose velocity alone is known.
Finding moving(registers::Model model, std::int64_t v_ist);

}  // namespace nplc::causes
