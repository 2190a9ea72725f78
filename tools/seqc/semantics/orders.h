#pragma once

#include "semantics/model.h"

namespace nplc::seqc {

/// What an order does to the motor's motion.
enum class MotionEffect : std::uint8_t {
    none,
    init,    ///< INIT mode: ends every motion
    run,     ///< continuous: a velocity, a gear
    place,   ///< ends by itself, at a position
    hold,    ///< position mode, the target stays
    home,    ///< continues whatever V_SOLL is (001 §4.4.13)
    drive,   ///< a torque mode, likewise (001 §4.1.4)
    stop,    ///< V_SOLL = 0
    speed,   ///< V_SOLL is nonzero again, the mode stays
    target,  ///< P_SOLL or P_FNC becomes 0
};

MotionEffect motion_effect_of(const Send& send);

/// A STOP does not end it.
inline bool outlasts_stop(MotionEffect effect) {
    return effect == MotionEffect::home || effect == MotionEffect::drive;
}
inline bool moves(MotionEffect effect) {
    return effect == MotionEffect::run || effect == MotionEffect::place || outlasts_stop(effect);
}

/// The first order of a rule that moves the motor; nullptr: there is none.
const Send* motion_of(const Rule& rule);

}  // namespace nplc::seqc
