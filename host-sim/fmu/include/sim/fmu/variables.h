#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/fmu/setup.h"
#include "sim/snapshot.h"

namespace nplc::sim::fmu {

enum class Kind : std::uint8_t { real, integer, bits, truth };  ///< Float64, Int32, UInt32, Boolean
enum class Causality : std::uint8_t { independent, parameter, input, output };

/// Value reference of a variable; these numbers never change.
enum class Id : std::uint8_t {
    time = 0,
    in0 = 1,  ///< to in5 = 6
    load_torque = 10,
    p_soll = 11,
    v_soll = 12,
    a_soll = 13,
    t_soll = 14,
    mode_reg = 15,
    load_inertia = 20,
    friction_torque = 21,
    has_low_stop = 22,
    low_stop = 23,
    has_high_stop = 24,
    high_stop = 25,
    stop_stiffness = 26,
    position = 40,
    velocity = 41,
    torque = 42,
    p_ist = 43,
    v_ist = 44,
    err_stat = 45,
    in_pos = 46,
    error = 47,
    mode = 48,
    out0 = 50,  ///< to out3 = 53
    step = 54,
    timer = 55,
    counter = 56,
    running = 57,
    link_up = 58,
};
inline constexpr std::size_t kReferences = 60;

constexpr Id behind(Id first, unsigned index) {
    return static_cast<Id>(static_cast<unsigned>(first) + index);
}

struct Variable {
    Id id;
    std::string name;
    Kind kind;
    Causality causality;
    std::string unit;  ///< for `real` only
    std::string description;
    double start = 0;  ///< for parameters and inputs
    std::optional<double> min{};
    std::optional<double> max{};
};

/// All values of a machine; a double can hold every kind of variable.
class Values {
  public:
    double operator[](Id id) const { return values_[static_cast<std::size_t>(id)]; }
    double& operator[](Id id) { return values_[static_cast<std::size_t>(id)]; }

  private:
    std::array<double, kReferences> values_{};
};

/// In ascending order of reference. `names`: the program's, for descriptions.
std::vector<Variable> variables_of(const Setup& setup, const Names& names = {});

/// Start values of parameters and inputs; others are zero.
Values start_values(const std::vector<Variable>& variables);

/// Start value of the parameters load_inertia and friction_torque.
double start_inertia(const Setup& setup);
double start_friction(const Setup& setup);

/// Seconds: a motor sample, or with a gateway the period of its input polling.
double internal_step(const Setup& setup);

/// Torque in N.m at T_SOLL = 1023 (001 §3.2.13: 1.57; MAC800 6.8).
double full_torque(registers::Model model);
/// Inertia of the bare virtual motor, kg.m2.
double motor_inertia(registers::Model model);

}  // namespace nplc::sim::fmu
