#pragma once

#include <cstdint>

namespace nplc::sim {

/// VF_OUT's and T_SOLL's most: the motor's full torque.
inline constexpr std::int32_t kFullTorque = 1023;

/// What a mode asks of everything below the profile for one sample of the outer loop (001 §4.4: which
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

}  // namespace nplc::sim
