#pragma once

#include "semantics/model.h"

namespace nplc::seqc {

/// What an order makes of the motor's motion.
enum class MotionEffect : std::uint8_t {
    none,
    stop,   ///< V_SOLL is 0: it ramps down, but for a search and for analogue torque
    init,   ///< INIT mode: whatever it did is over
    run,    ///< goes on without end: a velocity, a gear
    place,  ///< ends by itself, at a place
    drive,  ///< goes on whatever V_SOLL is: homing (001 §4.4.13), analogue torque (001 §4.1.4)
};

MotionEffect motion_effect_of(const Send& send);

inline bool moves(MotionEffect effect) {
    return effect == MotionEffect::run || effect == MotionEffect::place || effect == MotionEffect::drive;
}

/// The first order of a rule that moves the motor, or none.
const Send* motion_of(const Rule& rule);

}  // namespace nplc::seqc
