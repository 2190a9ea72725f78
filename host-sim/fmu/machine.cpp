#include "sim/fmu/machine.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "sequencer/table.h"
#include "sim/mac_motor.h"
#include "sim/motor_stage.h"
#include "sim/world.h"

namespace nplc::sim::fmu {
namespace {

constexpr double kTorqueUnits = 1023;

int torque_units(double newton_metres, registers::Model model) {
    return static_cast<int>(std::lround(newton_metres / full_torque(model) * kTorqueUnits));
}

double radians_of_count(registers::Model model) {
    return 2 * std::numbers::pi / registers::scale_of(model).counts_per_rev;
}

double pull_of(const Setup& setup) {
    return setup.plant ? setup.plant->torque : 0;
}

/// The plant file's values are used exactly while the parameters have their start values.
void couple(MacMotor& motor, const Setup& setup, const Values& values) {
    Load& load = motor.plant().load();
    const double ratio = 1 + values[Id::load_inertia] / motor_inertia(motor.model());
    if (setup.plant) {
        load = *setup.plant;
        load.torque += torque_units(values[Id::load_torque], motor.model());
    }
    if (!setup.plant || values[Id::load_inertia] != start_inertia(setup))
        load.inertia_256 = static_cast<double>(std::lround(256 * ratio));
    if (!setup.plant || values[Id::friction_torque] != start_friction(setup))
        load.friction_torque = torque_units(values[Id::friction_torque], motor.model());
    const double radians = radians_of_count(motor.model());
    const auto stop = [&](bool above, double place) {
        act(motor, action::StopMotor{.above = above,
                                     .counts = std::llround(place / radians),
                                     .torque_per_count = values[Id::stop_stiffness] * radians /
                                                         full_torque(motor.model()) * kTorqueUnits});
    };
    if (values[Id::has_low_stop] != 0) stop(false, values[Id::low_stop]);
    if (values[Id::has_high_stop] != 0) stop(true, values[Id::high_stop]);
}

void read_motor(const MacMotor& motor, Values& values) {
    const double radians = radians_of_count(motor.model());
    const double steps_a_second = kInnerSamples / constants_of(motor.model()).outer_period;
    values[Id::position] = motor.plant().position() * radians;
    values[Id::velocity] = motor.plant().velocity() * steps_a_second * radians;
    values[Id::torque] = motor.torque() * full_torque(motor.model()) / kTorqueUnits;
    values[Id::p_ist] = motor.p_ist();
    values[Id::v_ist] = motor.v_ist();
    values[Id::err_stat] = motor.err_stat();
    values[Id::mode] = motor.mode();
}

void pull(MacMotor& motor, const Setup& setup, double newton_metres) {
    motor.plant().load().torque = pull_of(setup) + torque_units(newton_metres, motor.model());
}

/// A motor whose registers a host writes.
class HostedMotor final : public Machine {
  public:
    explicit HostedMotor(const Setup& setup)
        : setup_(setup), motor_(setup.motor), next_sample_(motor_.sample_period()) {}

    void take_parameters(const Values& values) override { couple(motor_, setup_, values); }

    void set(Id input, double value) override {
        if (input == Id::load_torque) return pull(motor_, setup_, value);
        motor_.write(register_of(input), static_cast<std::int32_t>(value));
    }

    void advance(Time limit) override {
        for (; next_sample_ <= limit; next_sample_ += motor_.sample_period()) motor_.sample();
    }

    void read(Values& values) override {
        constexpr std::uint32_t kErrors = 0x0F;  // of ERR_STAT, what the status on the line shows
        read_motor(motor_, values);
        values[Id::in_pos] = motor_.in_position() ? 1 : 0;
        values[Id::error] = (motor_.err_stat() & kErrors) != 0 ? 1 : 0;
    }

  private:
    static std::uint8_t register_of(Id input) {
        switch (input) {
            case Id::p_soll:
                return registers::P_SOLL;
            case Id::v_soll:
                return registers::V_SOLL;
            case Id::a_soll:
                return registers::A_SOLL;
            case Id::t_soll:
                return registers::T_SOLL;
            default:
                return registers::MODE_REG;
        }
    }

    Setup setup_;
    MacMotor motor_;
    Time next_sample_;
};

/// The options of `nanoplc-sim run` without arguments.
WorldOptions world_options(registers::Model model) {
    WorldOptions options;
    options.motor = model;
    options.gateway.debounce = std::chrono::milliseconds{3};
    return options;
}

/// The gateway's firmware on its board, the line, the motor.
class GatewayAndMotor final : public Machine {
  public:
    explicit GatewayAndMotor(const Setup& setup)
        : setup_(setup), world_(*setup.table, world_options(setup.motor)) {
        if (world_.load_result().ok) return;
        const auto& fault = world_.load_result().fault;
        throw BadMachine(
            fmt::format("the table's term {}: {}", fault.term, sequencer::describe(fault.error)));
    }

    void take_parameters(const Values& values) override { couple(world_.mac(), setup_, values); }

    void set(Id input, double value) override {
        if (input == Id::load_torque) return pull(world_.mac(), setup_, value);
        world_.set_input(static_cast<unsigned>(input) - static_cast<unsigned>(Id::in0), value != 0);
    }

    void advance(Time limit) override {
        while (world_.now() < limit) world_.step(limit);
        if (!world_.mac().orders().empty()) static_cast<void>(world_.take_executed());
    }

    void read(Values& values) override {
        const Snapshot snapshot = world_.take_snapshot();
        read_motor(world_.mac(), values);
        values[Id::in_pos] = snapshot.in_position ? 1 : 0;
        values[Id::error] = snapshot.error ? 1 : 0;
        for (unsigned i = 0; i < kOutputs; ++i)
            values[behind(Id::out0, i)] = (snapshot.outputs >> i & 1) != 0 ? 1 : 0;
        values[Id::step] = snapshot.step;
        values[Id::timer] = snapshot.timer;
        values[Id::counter] = snapshot.counter;
        values[Id::running] = snapshot.running ? 1 : 0;
        values[Id::link_up] = snapshot.link_up ? 1 : 0;
    }

  private:
    Setup setup_;
    World world_;
};

}  // namespace

std::unique_ptr<Machine> make_machine(const Setup& setup) {
    if (setup.table) return std::make_unique<GatewayAndMotor>(setup);
    return std::make_unique<HostedMotor>(setup);
}

}  // namespace nplc::sim::fmu
