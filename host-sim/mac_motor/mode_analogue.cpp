// The modes that the analogue input steers: AV, AVZ, A2POS, APOS (001 §4.1.5, §4.1.6, §4.1.10, §4.1.11).
#include "sim/analogue_blocks.h"
#include "sim/mac_motor.h"

namespace nplc::sim {

std::int32_t MacMotor::analogue_v_soll() const {
    const std::int32_t aninp = memory_.get(cell::ANINP);
    return is_mode(MotorMode::analogue_velocity) ? analogue_velocity(model(), aninp, v_soll())
                                                 : analogue_velocity_with_dead_band(model(), aninp, v_soll());
}

void MacMotor::set_target_by_place() {
    memory_.set(cell::P_SOLL,
                analogue_position(memory_.get(cell::ANINP), memory_.get(cell::P1), memory_.get(cell::P1[1]),
                                  memory_.get(cell::P1[2]), memory_.get(cell::P_SOLL)));
}

// The three ways are those of a P register selected over FastMAC. R: so P_FNC - 16 x P2 in place of the
// text's P_FNC - P2, for P_FNC counts in 1/16.
void MacMotor::set_target_by_level() {
    if (analogue_level_.on() == analogue_was_on_) return;
    select_position(analogue_level_.on() ? 2 : 1);
}

}  // namespace nplc::sim
