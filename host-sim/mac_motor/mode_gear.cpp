// The modes that follow pulses: GP, AVG, AG, COIL, GF (001 §4.1.3, §4.1.7, §4.1.9, §4.1.12, §4.4.20).
#include <cstdlib>

#include "sim/analogue_blocks.h"
#include "sim/mac_motor.h"

namespace nplc::sim {

// R: AVG and AG have the block of Gear Position mode, which 001 §4.4.19 refers to.
void MacMotor::run_gear() {
    const std::int32_t aninp = memory_.get(cell::ANINP);
    const std::int32_t factor =
        is_mode(MotorMode::analogue_gear) ? analogue_gear_factor(model(), aninp) : Gear::kOne;
    gear_.take(
        gear_.scale(memory_.get(cell::V_EXT), memory_.get(cell::GEARF1), memory_.get(cell::GEARF2), factor));
    if (is_mode(MotorMode::analogue_velocity_gear)) gear_.take(analogue_trim(model(), aninp));
    if (is_mode(MotorMode::gear_follow)) {
        regulate(gear_follow_block(gear_.g_fnc(), v_from_, std::abs(v_soll()), acceleration()));
    } else {
        run_to(-gear_.g_fnc());
    }
    gear_.went(v_old_);
    show_gear_error();
}

Coil::Setup MacMotor::coil_setup() const {
    const auto p = [&](int n) { return std::int64_t{memory_.get(cell::P1[n - 1])}; };
    return {.left_thread = p(1),
            .left_stop = p(2),
            .right_stop = p(3),
            .right_thread = p(4),
            .start = p(5),
            .direction = p(6)};
}

// G_FNC is what P_FNC still has to go to the traverse's place.
void MacMotor::run_coil() {
    const Coil::Setup setup = coil_setup();
    const std::int64_t travel =
        gear_.scale(memory_.get(cell::V_EXT), memory_.get(cell::GEARF1), memory_.get(cell::GEARF2));
    coil_.step(setup, analogue_level_.on(), travel);
    const std::int32_t here = memory_.get(cell::P_FNC);
    const std::int64_t distance = wrap32(coil_.target_16(setup, here) - here);
    run_to(distance);
    gear_.stand_at(v_old_ - distance);
    show_gear_error();
}

/// FNCERR is a positioning error here (001 §3.2.24; R: only where the block is corrected).
void MacMotor::show_gear_error() {
    memory_.set(cell::G_FNC, wrap32(gear_.g_fnc()));
    if (facts().corrected) memory_.set(cell::FNCERR, wrap32(gear_.g_fnc()));
}

}  // namespace nplc::sim
