#pragma once

#include <cstdint>

#include "sequencer/state.h"

/// What orders do to the motor (001 §3.2, §4.4, §5.2.1.4).
namespace nplc::table {

enum class OrderKind : std::uint8_t {
    nothing,
    service,  ///< nothing to mode, place or speed: T_SOLL, IN_POS, the line
    reset_error,
    init,
    run,  ///< velocity and gear modes
    place,
    moves_by,  ///< MOVE_P7_BY_P_SOLL and its like
    set,       ///< USE_SET
    hold,      ///< position mode, the target stays
    home,
    stop,   ///< V_SOLL = 0
    speed,  ///< V_SOLL is nonzero again, the mode stays
    clears_p_soll,
    clears_p_ist,
    clears_p_fnc,
    target,  ///< P_SOLL, P_FNC or P_REG_P is written
    absolute,
    relative,
    // Values of MODE_REG with which IN_POS never comes:
    analogue_run,  ///< AV, AVG and AVZ
    drive,         ///< torque and test modes
    stop_mode,     ///< on the way to INIT
    other_mode,    ///< SAFE_MODE, which MODE_REG does not enter, and what is none
};

OrderKind kind_of_mode(std::uint32_t mode);
OrderKind kind_of(const sequencer::MotorOrder& order);

/// Of a mode: IN_POS never comes.
bool is_silent(OrderKind kind);

/// What an order does to a motion.
enum class MotionEffect : std::uint8_t {
    none,
    init,    ///< ends every motion
    run,     ///< continuous: a velocity, a gear
    place,   ///< ends by itself, at a position
    hold,    ///< position mode, the target stays
    home,    ///< continues whatever V_SOLL is (001 §4.4.13)
    drive,   ///< a torque mode, likewise (001 §4.1.4)
    stop,    ///< V_SOLL = 0
    speed,   ///< V_SOLL is nonzero again, the mode stays
    target,  ///< P_SOLL or P_FNC is another one, the mode stays
};

MotionEffect effect_of(OrderKind kind);

/// A STOP does not end it.
constexpr bool outlasts_stop(MotionEffect effect) {
    return effect == MotionEffect::home || effect == MotionEffect::drive;
}
constexpr bool moves(MotionEffect effect) {
    return effect == MotionEffect::run || effect == MotionEffect::place || outlasts_stop(effect);
}

/// The register that a command selects, 1..127; 0 for others.
std::uint8_t selected_register(const sequencer::MotorOrder& order);
/// The register that V_SOLL is taken from with this order, V1..V8; 0 if V_SOLL stays, or is written itself.
std::uint8_t velocity_taken(const sequencer::MotorOrder& order);
/// It clears the motor's errors and acknowledges a lost link; a write also with the register before ERR_STAT,
/// as a longword.
bool may_reset_error(const sequencer::MotorOrder& order);

}  // namespace nplc::table
