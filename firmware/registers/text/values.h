#pragma once

#include "registers/details.h"

namespace nplc::registers {

// Meanings of the values of modes and pointers. `Small`: MAC50, 95, 140 and 141.
// clang-format off
/// 001 §3.2.2, §4.4
inline constexpr NamedValue kSmallModes[] = {
    {0, "INIT_MODE", "passive: the windings are shorted, which brakes a turning shaft"},
    {1, "V_MODE", "velocity: runs at V_SOLL"},
    {2, "P_MODE", "position: goes to P_SOLL"},
    {3, "GP_MODE", "gear position: follows the pulse input, stops without overshoot"},
    {4, "AT_MODE", "analogue torque: 10 V is T_SOLL"},
    {5, "AV_MODE", "analogue velocity: 10 V is V_SOLL"},
    {6, "AVG_MODE", "gear plus analogue velocity: 10 V adds 300 rpm"},
    {7, "MANI_MODE", "manual current: turns the stator's field by hand"},
    {8, "TESTU_MODE", "test: a step of voltage on the windings"},
    {9, "TESTA_MODE", "test: acceleration with T_SOLL"},
    {10, "BREAK_MODE", "braking after TESTA_MODE; comes by itself"},
    {11, "STOP_MODE", "slows down on the way to INIT_MODE; comes by itself"},
    {12, "HOME1_MODE", "homing against a mechanical stop"},
    {13, "HOME2_MODE", "homing to where the sensor switches on"},
    {14, "HOME3_MODE", "homing to where the sensor switches off, slowly"},
    {15, "SAFE_MODE", "passive, deaf to FastMAC and FlexMAC; not entered or left by this register"},
    {16, "AVZ_MODE", "analogue velocity with a dead band around 0 V"},
    {17, "VAT_MODE", "velocity, its torque limit set by the analogue input"},
    {18, "AG_MODE", "gear, its ratio trimmed by the analogue input"},
    {19, "COIL_MODE", "winds a coil: gear that turns round at P1 and P4"},
    {20, "A2POS_MODE", "two positions, P1 and P2, chosen by the level at the analogue input"},
    {21, "APOS_MODE", "position given by the analogue input"},
    {22, "TESTKI_MODE", "test: gain of the current measurement"},
    {23, "TESTTQ_MODE", "test: friction torque"},
    {24, "GF_MODE", "gear follow: follows the pulse input with the least lag, may overshoot"},
    {256, "LOAD_DEFAULTS", "in SAFE_MODE only: takes the maker's values, keeps them in flash, resets"},
    {257, "TRY_DEFAULTS", "in SAFE_MODE only: takes the maker's values without keeping them"},
    {258, "LOAD_SAVED", "in SAFE_MODE only: takes the values last saved in flash"},
};

/// 004, register 2; the names are 001's
inline constexpr NamedValue kMac800Modes[] = {
    {0, "INIT_MODE", "passive"},
    {1, "V_MODE", "velocity"},
    {2, "P_MODE", "position"},
    {3, "GP_MODE", "gear"},
    {4, "AT_MODE", "torque by the analogue input"},
    {5, "AV_MODE", "velocity by the analogue input"},
    {6, "AVG_MODE", "gear plus analogue velocity"},
    {7, "MANI_MODE", "reserved"},
    {8, "TESTU_MODE", "reserved"},
    {9, "TESTA_MODE", "reserved"},
    {10, "BREAK_MODE", "reserved"},
    {11, "STOP_MODE", "reserved"},
    {12, "HOME1_MODE", "homing against a mechanical stop"},
    {13, "HOME2_MODE", "homing with a sensor, first kind"},
    {14, "HOME3_MODE", "homing with a sensor, second kind"},
    {15, "SAFE_MODE", "passive, deaf to FastMAC and FlexMAC; not entered or left by this register"},
    {16, "AVZ_MODE", "analogue velocity with a dead band"},
    {17, "VAT_MODE", "velocity, torque limit by the analogue input"},
    {18, "AG_MODE", "gear, trimmed by the analogue input"},
    {19, "COIL_MODE", "winds a coil"},
    {20, "A2POS_MODE", "two positions, as an air cylinder"},
    {21, "APOS_MODE", "position by the analogue input"},
};

/// 001 §3.2.42; 004, register 2
inline constexpr NamedValue kHomingModes[] = {
    {0, "NONE", "no homing"},
    {12, "HOME1_MODE", "against a mechanical stop"},
    {13, "HOME2_MODE", "with a sensor: where it switches on"},
    {14, "HOME3_MODE", "with a sensor: where it switches off"},
};

/// 001 §3.2.36
inline constexpr NamedValue kUserInterfaces[] = {
    {0, "INPUT", "pulse input: quadrature, or pulse and direction"},
    {1, "OUTPUT", "the encoder's quadrature signal goes out"},
    {3, "COMMUNICATION", "FastMAC / FlexMAC"},
};

// 001 §3.2.43-48
inline constexpr std::string_view kNothing = "nothing to do; the motor sets it when the copy is made";
inline constexpr NamedValue kToP[] = {
    {0, "NONE", kNothing},
    {1, "P1", "P1 to P_SOLL, or relative as RELPOSPSOLL and RELPOSPFNC say"},
    {2, "P2", "the same with P2"}, {3, "P3", "the same with P3"}, {4, "P4", "the same with P4"},
    {5, "P5", "the same with P5"}, {6, "P6", "the same with P6"}, {7, "P7", "the same with P7"},
    {8, "P8", "the same with P8"},
};
inline constexpr NamedValue kToV[] = {
    {0, "NONE", kNothing},
    {1, "V1", "V1 to V_SOLL"}, {2, "V2", "V2 to V_SOLL"}, {3, "V3", "V3 to V_SOLL"}, {4, "V4", "V4 to V_SOLL"},
    {5, "V5", "V5 to V_SOLL"}, {6, "V6", "V6 to V_SOLL"}, {7, "V7", "V7 to V_SOLL"}, {8, "V8", "V8 to V_SOLL"},
};
inline constexpr NamedValue kToA[] = {
    {0, "NONE", kNothing},
    {1, "A1", "A1 to A_SOLL"}, {2, "A2", "A2 to A_SOLL"}, {3, "A3", "A3 to A_SOLL"}, {4, "A4", "A4 to A_SOLL"},
};
inline constexpr NamedValue kToT[] = {
    {0, "NONE", kNothing},
    {1, "T1", "T1 to T_SOLL"}, {2, "T2", "T2 to T_SOLL"}, {3, "T3", "T3 to T_SOLL"}, {4, "T4", "T4 to T_SOLL"},
};
inline constexpr NamedValue kToL[] = {
    {0, "NONE", kNothing},
    {1, "L1", "L1 to KVOUT"}, {2, "L2", "L2 to KVOUT"}, {3, "L3", "L3 to KVOUT"}, {4, "L4", "L4 to KVOUT"},
};
inline constexpr NamedValue kToZ[] = {
    {0, "NONE", kNothing},
    {1, "Z1", "Z1 to INPOSWIN"}, {2, "Z2", "Z2 to INPOSWIN"},
    {3, "Z3", "Z3 to INPOSWIN"}, {4, "Z4", "Z4 to INPOSWIN"},
};
// clang-format on

}  // namespace nplc::registers
