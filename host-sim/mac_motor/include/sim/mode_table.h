#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nplc::sim {

/// Limit of VF_OUT and T_SOLL: the motor's full torque.
inline constexpr std::int32_t kFullTorque = 1023;

/// What a mode requests from the stages below the profile for one sample of the outer loop (001 §4.4: which
/// regulators are active).
struct Drive {
    enum class Kind : std::uint8_t {
        shorted,          ///< both regulators passive, the windings short-circuited (INIT, SAFE)
        velocity,         ///< the speed regulator follows `fnc_out` within `torque_limit`
        torque,           ///< speed regulator passive, VF_OUT = `torque` (TESTA, BREAK, the end of AT)
        analogue_torque,  ///< speed regulator passive, VF_OUT = ANINP, +/- 10 V being +/- `torque_limit`, at
                          ///< the inner rate (AT)
        field,            ///< current regulator on MAN_I_NOM at MAN_ALPHA (MANI)
        voltage,          ///< both passive, UA_VAL = UMEAS and UC_VAL = -UMEAS (TESTU)
    };
    Kind kind = Kind::shorted;
    std::int32_t fnc_out = 0;       ///< 1/16 counts/sample
    std::int32_t torque_limit = 0;  ///< 0..1023
    std::int32_t torque = 0;        ///< -1023..1023
};

/// MODE_REG (001 §3.2.2).
enum class MotorMode : std::uint16_t {
    init = 0,
    velocity = 1,
    position = 2,
    gear_position = 3,
    analogue_torque = 4,
    analogue_velocity = 5,
    analogue_velocity_gear = 6,
    manual = 7,
    test_voltage = 8,       ///< TESTU
    test_acceleration = 9,  ///< TESTA
    brake = 10,             ///< BREAK
    stop = 11,
    home1 = 12,
    home2 = 13,
    home3 = 14,
    safe = 15,
    analogue_velocity_dead_band = 16,  ///< AVZ
    velocity_analogue_torque = 17,     ///< VAT
    analogue_gear = 18,
    coil = 19,
    analogue_two_positions = 20,  ///< A2POS
    analogue_position = 21,       ///< APOS
    test_current = 22,            ///< TESTKI
    test_torque = 23,             ///< TESTTQ
    gear_follow = 24,
};

constexpr std::uint16_t number(MotorMode mode) {
    return static_cast<std::uint16_t>(mode);
}

/// Properties of a mode in 001 §4.4.
struct ModeFacts {
    /// The function block (001 §4.1).
    enum class Block : std::uint8_t {
        none,
        velocity,           ///< §4.1.1, towards V_SOLL
        analogue_velocity,  ///< §4.1.5, §4.1.6
        position,           ///< §4.1.2, §4.1.10, §4.1.11
        gear,               ///< §4.1.3, §4.1.7, §4.1.9, §4.1.12
        coil,               ///< §4.4.20
        homing,             ///< §4.4.13 to §4.4.15
        stop,               ///< §4.1.8
    };
    /// How the mode is left.
    enum class Leave : std::uint8_t {
        at_once,   ///< the motor is at rest, or may be left as it is
        stopping,  ///< to INIT, and to a mode that must begin at rest, through STOP
        coasting,  ///< to INIT only, without torque until the motor is slow (AT)
        test,      ///< ends by itself; before that to INIT only, through STOP (TESTA, BREAK)
    };
    /// IN_POS (001 §3.2.33).
    enum class InPosition : std::uint8_t { never, velocity, position, gear };

    std::string_view name;
    Drive::Kind drive = Drive::Kind::shorted;
    Block block = Block::none;
    Leave leave = Leave::at_once;
    InPosition in_position = InPosition::never;
    bool corrected = false;       ///< "correction of function block: active"
    bool counts_pulses = false;   ///< V_EXT is updated (001 §3.2.120; R: in GF_MODE too)
    bool begins_at_rest = false;  ///< R: not entered in motion

    bool homing() const { return block == Block::homing; }
    /// The speed regulator is active.
    bool driven() const { return drive == Drive::Kind::velocity; }
    /// Gear factor and pulses determine the motion.
    bool geared() const { return block == Block::gear || block == Block::coil; }
};

inline constexpr std::size_t kModeCount = 25;
extern const std::array<ModeFacts, kModeCount> kModes;

/// Null if there is no such mode.
inline const ModeFacts* facts_of(std::uint16_t mode) {
    return mode < kModes.size() ? &kModes[mode] : nullptr;
}

}  // namespace nplc::sim
