#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "registers/mac.h"

/// The plant of an axis (the load of a motor's shaft) as a TOML file: written by `macreg fit`, read by the
/// simulators.
namespace nplc::plant_file {

/// Values at the motor's shaft. Missing ones are the simulators' defaults.
struct Plant {
    std::string motor{};                       ///< "MAC140", or "MAC50-141" for any of these
    int motor_line = 1;                        ///< its line in the file
    std::optional<double> inertia{};           ///< kg m2, motor and load
    std::optional<double> coulomb_friction{};  ///< N m
    std::optional<double> viscous_friction{};  ///< N m s/rad
    std::optional<double> constant_load{};     ///< N m, positive turns the shaft forward
    std::optional<double> dead_time{};         ///< s, from the requested torque (VF_OUT) to the shaft's
    std::optional<double> torque_constant{};   ///< relative to the motor's nominal one
};

/// A value of a Plant: its key in the file, unit, description and range.
struct Item {
    std::string_view key;
    std::string_view unit;
    std::string_view meaning;
    double least;
    double most;
    std::optional<double> Plant::*value;
};
std::span<const Item> items();

struct Reading {
    Plant plant{};
    std::string error{};  ///< "axis.toml:3: ...", with the remedy; empty on success
};
/// `name`: of the file, for messages.
Reading read_plant(std::string_view text, const std::string& name);

/// Why a simulated `model` cannot have this plant, one line; empty if it can.
std::string mismatch(const Plant& plant, registers::Model model);

/// Nominal data of a motor family, used for the virtual motors too (001 §3.2.13).
struct Motor {
    double full_torque;    ///< N m at VF_OUT 1023
    double inertia;        ///< kg m2, of the bare motor
    double radians;        ///< per count
    double sample;         ///< s, of the outer loop
    double current_delay;  ///< s, torque delay of the current loop: part of every dead time
};
Motor motor_of(registers::Model model);

/// The same in register units: torques as in VF_OUT, 1023 is the motor's nominal full torque.
struct Load {
    std::optional<double> inertia{};  ///< relative to the motor's own: KVOUT's meaning
    std::optional<double> coulomb_friction{};
    std::optional<double> viscous_friction{};  ///< per count/sample
    std::optional<double> constant_load{};
    std::optional<double> dead_time{};  ///< samples, including the current loop's own
};
/// A motor with another torque constant moves like one whose loads are all divided by it.
Load in_motor_terms(const Plant& plant, registers::Model model);

}  // namespace nplc::plant_file
