#pragma once

#include "sim/mac_motor.h"
#include "sim/scenario_runner.h"

namespace nplc::sim {

/// A motor without a gateway, on which a scenario plays whose Names are `motor_alone`.
class MotorAlone final : private Stage {
  public:
    /// All three outlive it. What the flash holds is stored at once, and if there are pulses and the user
    /// interface is free for them, that it is the pulse input.
    MotorAlone(MacMotor& motor, const Scenario& scenario, const Names& names);

    bool powered() const { return powered_; }
    /// When the scenario wants to be looked at.
    std::optional<Time> next_due() const { return runner_.next_due(); }
    /// After each sample, and when it is due. Throws EndlessRules.
    void observe(Time now);

  private:
    void set_input(unsigned, bool) override {}
    void toggle_input(unsigned) override {}
    void cut_line(bool) override {}
    void spoil_line(const action::SpoilLine&) override {}
    void seed(std::uint64_t) override {}
    void fail_motor() override { motor_.overload(); }
    void load_motor(int torque) override;
    void set_brake(int torque) override;
    void power_motor(bool on) override;
    void stop_motor(const action::StopMotor& stop) override;
    void free_motor() override;
    void connect_sensor(const action::MotorSensor& sensor) override;
    void set_drive_input(const action::SetDriveInput&) override {}
    void connect_switch(const action::DriveSwitch&) override {}
    void set_analogue(double volts) override;
    void set_pulses(const action::MotorPulses& pulses) override;
    void set_supply(const action::MotorSupply& supply) override;
    void set_temperature(int celsius) override;
    void break_encoder() override;
    void gateway(action::Gateway) override {}
    void log(const std::string&) override {}

    MacMotor& motor_;
    ScenarioRunner runner_;
    bool powered_ = true;
};

}  // namespace nplc::sim
