#include "sim/fmu/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string_view>

#include "sim/mac_motor.h"
#include "sim/world.h"

namespace nplc::sim::fmu {
namespace {

constexpr double kMostLoad = 10'000;   // in units of T_SOLL, as in scenarios
constexpr double kMostInertia = 1000;  // times the motor's own
constexpr double kFarthest = 1e6;      // rad
constexpr double kStiffest = 1e6;      // N.m/rad

using registers::Model;

class List {
  public:
    List(const Setup& setup, const Names& names)
        : setup_(setup), model_(setup.motor), with_gateway_(setup.table.has_value()), names_(names) {}

    std::vector<Variable> make() && {
        add(Id::time, "time", Kind::real, Causality::independent, "s", "Simulated time");
        if (with_gateway_) add_terminals();
        add_load();
        if (!with_gateway_) add_registers();
        add_plant();
        add_shaft();
        if (with_gateway_) add_gateway();
        return std::move(list_);
    }

  private:
    Variable& add(Id id, std::string name, Kind kind, Causality causality, std::string unit,
                  std::string description) {
        list_.push_back({id, std::move(name), kind, causality, std::move(unit), std::move(description)});
        return list_.back();
    }
    void add_within(Id id, std::string name, std::string unit, std::string description, Causality causality,
                    double start, double min, double max) {
        Variable& variable =
            add(id, std::move(name), Kind::real, causality, std::move(unit), std::move(description));
        variable.start = start;
        variable.min = min;
        variable.max = max;
    }
    void output(Id id, std::string name, Kind kind, std::string unit, std::string description) {
        add(id, std::move(name), kind, Causality::output, std::move(unit), std::move(description));
    }

    void add_terminals() {
        for (unsigned i = 0; i < kInputs; ++i) {
            const std::string terminal = fmt::format("IN{}", i);
            add(behind(Id::in0, i), terminal, Kind::truth, Causality::input, "",
                "Level at the gateway's input terminal" +
                    named((names_.is_inverted(i) ? "NOT " : "") + names_.inputs[i], terminal));
        }
    }

    void add_load() {
        const double most = kMostLoad / 1023 * full_torque(model_);
        add_within(
            Id::load_torque, "load_torque", "N.m",
            fmt::format("Constant pull on the shaft, positive forward; in steps of {:.3f} mN.m (1/1023 of "
                        "the motor's full torque)",
                        1000 * full_torque(model_) / 1023),
            Causality::input, 0, -most, most);
    }

    void add_registers() {
        const MacMotor motor(model_);
        const auto add_register = [&](Id id, std::uint8_t number, std::string_view what) {
            const registers::Register* reg = registers::find(model_, number);
            Variable& variable = add(
                id, std::string(reg->name), Kind::integer, Causality::input, "",
                fmt::format("{} (register {}); a new value is written as a host writes it", what, number));
            variable.start = motor.read(number);
            variable.min = static_cast<double>(reg->min);
            variable.max = static_cast<double>(reg->max);
        };
        add_register(Id::p_soll, registers::P_SOLL, "Wanted position, counts");
        add_register(Id::v_soll, registers::V_SOLL, "Wanted speed, 1/16 counts a sample");
        add_register(Id::a_soll, registers::A_SOLL, "Wanted acceleration, 1/16 counts a sample squared");
        add_register(Id::t_soll, registers::T_SOLL, "Most torque, 1023 is the motor's full torque");
        add_register(Id::mode_reg, registers::MODE_REG,
                     "Wanted mode: 0 passive, 1 velocity, 2 position, further ones as in the manual");
    }

    void add_plant() {
        const auto parameter = [&](Id id, std::string name, std::string unit, std::string description,
                                   double start, double min, double max) {
            add_within(id, std::move(name), std::move(unit), std::move(description), Causality::parameter,
                       start, min, max);
        };
        const auto choice = [&](Id id, std::string name, std::string description) {
            add(id, std::move(name), Kind::truth, Causality::parameter, "", std::move(description));
        };
        const double full = full_torque(model_);
        const double own = motor_inertia(model_);
        parameter(
            Id::load_inertia, "load_inertia", "kg.m2",
            fmt::format("Inertia of the load at the shaft, in steps of 1/256 of the motor's own {:.3g}", own),
            start_inertia(setup_), std::min(0.0, start_inertia(setup_)), kMostInertia * own);
        parameter(Id::friction_torque, "friction_torque", "N.m", "Coulomb friction at the shaft",
                  start_friction(setup_), 0, kMostLoad / 1023 * full);
        choice(Id::has_low_stop, "has_low_stop", "There is a mechanical stop at low_stop");
        parameter(Id::low_stop, "low_stop", "rad", "Where the shaft is stopped when it turns backward", 0,
                  -kFarthest, kFarthest);
        choice(Id::has_high_stop, "has_high_stop", "There is a mechanical stop at high_stop");
        parameter(Id::high_stop, "high_stop", "rad", "Where the shaft is stopped when it turns forward", 0,
                  -kFarthest, kFarthest);
        parameter(Id::stop_stiffness, "stop_stiffness", "N.m/rad", "Of both stops; 0: rigid ones", 0, 0,
                  kStiffest);
    }

    void add_shaft() {
        output(Id::position, "position", Kind::real, "rad",
               "Angle of the shaft from where it was at the start, whatever P_IST was set to");
        output(Id::velocity, "velocity", Kind::real, "rad/s", "Angular velocity of the shaft");
        output(Id::torque, "torque", Kind::real, "N.m",
               "Torque that the regulator asks of the motor (VF_OUT)");
        output(Id::p_ist, "P_IST", Kind::integer, "",
               fmt::format("Position register, counts; {} a revolution",
                           registers::scale_of(model_).counts_per_rev));
        output(Id::v_ist, "V_IST", Kind::integer, "", "Speed register, counts a sample");
        output(Id::err_stat, "ERR_STAT", Kind::bits, "",
               "Register of errors and states, bits as in the manual");
        const std::string who = with_gateway_ ? ", as the gateway has taken it as valid" : "";
        output(Id::in_pos, "IN_POS", Kind::truth, "", "The motor is in position" + who);
        output(Id::error, "ERROR", Kind::truth, "", "The motor reports an error" + who);
        output(Id::mode, "MODE", Kind::integer, "", "Mode that the motor is in (MODE_REG as it is read)");
    }

    void add_gateway() {
        for (unsigned i = 0; i < kOutputs; ++i) {
            const std::string terminal = fmt::format("OUT{}", i);
            output(behind(Id::out0, i), terminal, Kind::truth, "",
                   "Level at the gateway's output terminal" + named(names_.outputs[i], terminal));
        }
        std::string steps;
        for (const auto& [number, name] : names_.steps)
            steps += fmt::format("{}{} {}", steps.empty() ? ": " : ", ", number, name);
        output(Id::step, "step", Kind::integer, "", "Active step of the sequence" + steps);
        output(Id::timer, "timer", Kind::integer, "", "The sequence's timer, ms");
        output(Id::counter, "counter", Kind::integer, "", "The sequence's counter");
        output(Id::running, "running", Kind::truth, "", "The sequence runs");
        output(Id::link_up, "link_up", Kind::truth, "", "The link to the motor is up");
    }

    static std::string named(const std::string& name, const std::string& terminal) {
        return name.empty() || name == terminal ? "" : fmt::format(": {}", name);
    }

    const Setup& setup_;
    Model model_;
    bool with_gateway_;
    const Names& names_;
    std::vector<Variable> list_;
};

}  // namespace

std::vector<Variable> variables_of(const Setup& setup, const Names& names) {
    return List(setup, names).make();
}

Values start_values(const std::vector<Variable>& variables) {
    Values values;
    for (const Variable& variable : variables) values[variable.id] = variable.start;
    return values;
}

double start_inertia(const Setup& setup) {
    return setup.plant ? (setup.plant->inertia_256 / 256 - 1) * motor_inertia(setup.motor) : 0;
}

double start_friction(const Setup& setup) {
    return setup.plant.value_or(Load{}).friction_torque * full_torque(setup.motor) / 1023;
}

double internal_step(const Setup& setup) {
    using Seconds = std::chrono::duration<double>;
    return Seconds(setup.table ? World::kPollPeriod : Time(MacMotor(setup.motor).sample_period())).count();
}

double full_torque(Model model) {
    return model == Model::mac800 ? 6.8 : 1.57;
}

double motor_inertia(Model model) {
    const MotorConstants& constants = constants_of(model);
    const double radians = 2 * std::numbers::pi / registers::scale_of(model).counts_per_rev;
    const double acceleration =
        constants.full_acceleration * radians / (constants.outer_period * constants.outer_period);
    return full_torque(model) / acceleration;
}

}  // namespace nplc::sim::fmu
