#pragma once

#include <cstdint>
#include <string_view>

namespace nplc::sim {

/// MODE_REG (001 §3.2.2). Those not named here are not simulated yet.
enum class MotorMode : std::uint16_t {
    init = 0,
    velocity = 1,
    position = 2,
    gear_position = 3,
    stop = 11,
    home1 = 12,
    home2 = 13,
    home3 = 14,
    safe = 15,
    gear_follow = 24,
};

constexpr std::uint16_t number(MotorMode mode) {
    return static_cast<std::uint16_t>(mode);
}

/// What 001 §4.4 says of a mode.
struct ModeFacts {
    std::string_view name;
    bool simulated = false;
    bool driven = false;         ///< the regulators are active
    bool corrected = false;      ///< "correction of function block: active"
    bool counts_pulses = false;  ///< V_EXT is updated (001 §3.2.120; R: in GF_MODE too)
    bool homing = false;
};

/// Null: there is no such mode.
const ModeFacts* facts_of(std::uint16_t mode);

}  // namespace nplc::sim
