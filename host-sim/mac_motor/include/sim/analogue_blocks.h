#pragma once

#include <cstdint>

#include "registers/mac.h"

namespace nplc::sim {

/// What the function blocks of 001 §4.1 make of ANINP. +/- 10 V is +/- 1023, on MAC800 +/- 2048. All cut
/// towards 0.

/// AV (001 §4.1.5): +/- 10 V is +/- V_SOLL, and more than that it never is (R), ANINP_OFFSET or not.
std::int32_t analogue_velocity(registers::Model model, std::int32_t aninp, std::int32_t v_soll);

/// AVZ (001 §4.1.6): nothing within +/- 64 (R: MAC800 128), else what is beyond it x 0.0010416 x V_SOLL.
std::int32_t analogue_velocity_with_dead_band(registers::Model model, std::int32_t aninp,
                                              std::int32_t v_soll);

/// AVG (001 §4.1.7): +/- 10 V is +/- 300 rpm, in 1/16 counts/sample.
std::int32_t analogue_trim(registers::Model model, std::int32_t aninp);

/// VAT (001 §4.4.18): |ANINP x T_SOLL / 1024| (R: MAC800 / 2048).
std::int32_t analogue_torque_limit(registers::Model model, std::int32_t aninp, std::int32_t t_soll);

/// AG (001 §4.1.9): 1.15 at 10 V, 1 at 0 V, 0.87 at -10 V, x 65536. R: 1.15 ^ (ANINP / 1023).
std::int32_t analogue_gear_factor(registers::Model model, std::int32_t aninp);

/// APOS (001 §4.1.11): the new P_SOLL. R: P_NEW there is no register.
std::int32_t analogue_position(std::int32_t aninp, std::int32_t p1, std::int32_t p2, std::int32_t p3,
                               std::int32_t p_soll);

}  // namespace nplc::sim
