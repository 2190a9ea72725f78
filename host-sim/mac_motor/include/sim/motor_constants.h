#pragma once

#include "registers/mac.h"
#include "sim/supply.h"

namespace nplc::sim {

/// The iron and copper of a family, ours; the folder's README says from what. MAC50, 95, 140 and 141 share
/// one.
struct MotorConstants {
    double outer_period;       ///< s
    double full_acceleration;  ///< of the bare motor at full torque, counts/sample^2 of the outer loop
    double emf_inertia;        ///< of the motor's, what a rising EMF makes of it with the box's current loop
    std::int32_t counts_a_field;  ///< encoder counts in a turn of the field
    double full_current;          ///< peak phase current at full torque, register units
    double resistance;            ///< voltage units a current unit
    double decay;                 ///< of a current in a sample of the inner loop
    double emf;                   ///< voltage units a count of the inner loop
    double volts_of_one;          ///< V a voltage unit at the nominal supply
    double amperes_of_one;        ///< A a current unit
    double nominal_volts;         ///< of the supply
    double volts_register;        ///< U_SUPPLY or U_BUS, units a volt
    Supply::Constants supply;
    double dump_watts;      ///< that the dump bears for ever: UIT becomes 10000
    double dump_seconds;    ///< its time constant
    double copper_seconds;  ///< time constant of I2T; 10000 at a third of full torque
    double warming;         ///< degrees above the air at I2T = 10000 (MAC800)
};

/// Samples of the inner loop in one of the outer (001 §1.2; R: on MAC800 too).
inline constexpr int kInnerSamples = 15;

const MotorConstants& constants_of(registers::Model model);

}  // namespace nplc::sim
