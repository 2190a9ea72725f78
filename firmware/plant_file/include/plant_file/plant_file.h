#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "registers/mac.h"

/// The plant of an axis, what a motor's shaft is coupled to, as a file in TOML: `macreg fit` writes it, the
/// simulators take it.
namespace nplc::plant_file {

/// At the motor's shaft. What is not there is as the simulators have it without a file.
struct Plant {
    std::string motor{};                       ///< "MAC140", or of MAC50 to MAC141 any: "MAC50-141"
    int motor_line = 1;                        ///< where the file says it
    std::optional<double> inertia{};           ///< kg m2, motor and load
    std::optional<double> coulomb_friction{};  ///< N m
    std::optional<double> viscous_friction{};  ///< N m s/rad
    std::optional<double> constant_load{};     ///< N m, positive turns the shaft forward
    std::optional<double> dead_time{};         ///< s, from the torque asked for (VF_OUT) to the shaft's
    std::optional<double> torque_constant{};   ///< times the motor's nominal one
};

/// A value of a Plant: its key in the file, its unit, what it is, and its range.
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
    std::string error{};  ///< "axis.toml:3: ...", with what to do; empty if it was understood
};
/// `name` is the file's, for messages.
Reading read_plant(std::string_view text, const std::string& name);

/// Why a simulated `model` cannot have this plant, one line; empty if it can.
std::string mismatch(const Plant& plant, registers::Model model);

/// What the motors of a family are taken to be, the virtual ones too (001 §3.2.13).
struct Motor {
    double full_torque;    ///< N m at VF_OUT 1023
    double inertia;        ///< kg m2, of the bare motor
    double radians;        ///< of a count
    double sample;         ///< s, of the outer loop
    double current_delay;  ///< s, by which the current loop's torque is late: part of every dead time
};
Motor motor_of(registers::Model model);

/// The same in the registers' terms: torques as in VF_OUT, 1023 is what the motor is said to give.
struct Load {
    std::optional<double> inertia{};  ///< over the motor's own: KVOUT's meaning
    std::optional<double> coulomb_friction{};
    std::optional<double> viscous_friction{};  ///< a count/sample
    std::optional<double> constant_load{};
    std::optional<double> dead_time{};  ///< samples, with the current loop's own
};
/// A motor with another torque constant moves as one with all that it drives divided by it.
Load in_motor_terms(const Plant& plant, registers::Model model);

}  // namespace nplc::plant_file
