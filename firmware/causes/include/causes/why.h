#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "causes/finding.h"
#include "causes/modes.h"
#include "causes/snapshot.h"
#include "registers/mac.h"

/// Diagnoses why a motor does not move (001 §4.4, §4.5, 004).
namespace nplc::causes {

/// The state of a gateway between the client and the motor.
struct GatewayState {
    std::uint32_t status = 0;       ///< its STATUS
    std::uint32_t safe_reason = 0;  ///< its SAFE_REASON
};

/// The input of `why`: the same registers twice, some time apart.
struct Condition {
    registers::Model model = registers::Model::mac140;
    Snapshot before{};
    Snapshot now{};
    std::optional<GatewayState> gateway{};
};

/// The registers that a condition needs; each once.
std::vector<const registers::Register*> judged(registers::Model model);
/// The ones used from `before`; the others are not read there.
std::vector<const registers::Register*> judged_before(registers::Model model);

/// The causes that keep the motor from moving, the most urgent first. Pure; never empty: without another
/// cause it is "unknown", with what was checked. A motor that moves is reported as "moves".
std::vector<Finding> why(const Condition& condition);
/// The same where nothing is known of the motor: the gateway's own findings. May be empty.
std::vector<Finding> why(const GatewayState& gateway);
/// "moves", of a motor whose velocity alone is known, or not even that.
Finding moving(registers::Model model, std::optional<std::int64_t> v_ist);

}  // namespace nplc::causes
