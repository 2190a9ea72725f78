#pragma once

#include <utility>

#include "sim/mac_motor.h"
#include "sim/motor_stage.h"
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
    /// Does these too, from now on; with the next observe().
    void also(Actions actions, Time now) { runner_.also(std::move(actions), now); }
    /// After each sample, and when it is due. Throws EndlessRules.
    void observe(Time now);

  private:
    void fail_motor() override { motor_.overload(); }
    void power_motor(bool on) override;
    void act(const action::OnMotor& what) override { sim::act(motor_, what); }

    MacMotor& motor_;
    ScenarioRunner runner_;
    bool powered_ = true;
};

}  // namespace nplc::sim
