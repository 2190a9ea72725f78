#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/midi_module.h"
#include "sim/scenario_runner.h"

namespace nplc::sim {

/// Converts a position in a motor's counts to increments of a module's shaft.
std::int64_t increments_of(registers::midi::Model model, std::int64_t counts);

/// False: a module does not have this part.
bool act(MidiModule& module, const action::OnMotor& what);

/// A module without a gateway as the stage of actions.
class ModuleAlone final : private Stage {
  public:
    /// `module` must outlive this.
    explicit ModuleAlone(MidiModule& module) : module_(module), runner_(nothing_, names_, *this) {}

    /// Adds actions from now on; they start at the next observe(). Returns without_effect() of them.
    std::string also(Actions actions, Time now);
    /// To be called regularly: carries out due actions.
    void observe(Time now);

  private:
    void fail_motor() override { module_.overload_amplifier(); }
    void power_motor(bool on) override { on ? module_.power_on() : module_.power_off(); }
    void act(const action::OnMotor& what) override { static_cast<void>(sim::act(module_, what)); }

    MidiModule& module_;
    Scenario nothing_;
    Names names_;
    ScenarioRunner runner_;
};

}  // namespace nplc::sim
