#pragma once

#include <string>

#include "sim/mac_motor.h"
#include "sim/motor_stage.h"
#include "sim/scenario_runner.h"

namespace nplc::sim {

/// A motor without a gateway as the stage of a scenario whose Names have `motor_alone`.
class MotorAlone final : private Stage {
  public:
    /// All three parameters must outlive it. The flash contents are stored at once, including the selection
    /// of the pulse input if there are pulses and the user interface is free for them.
    MotorAlone(MacMotor& motor, const Scenario& scenario, const Names& names);

    bool powered() const { return powered_; }
    /// Time of the scenario's next event.
    std::optional<Time> next_due() const { return runner_.next_due(); }
    /// Adds actions from now on; they start at the next observe(). Returns without_effect() of them.
    std::string also(Actions actions, Time now);
    /// To be called after each sample, and when due. Throws EndlessRules.
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
