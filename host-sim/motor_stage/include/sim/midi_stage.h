#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "sim/midi_module.h"
#include "sim/scenario_runner.h"

namespace nplc::sim {

/// Of a place in a motor's counts: the increments of a module's shaft.
std::int64_t increments_of(registers::midi::Model model, std::int64_t counts);

/// False: a module has no such thing.
bool act(MidiModule& module, const action::OnMotor& what);

/// A module without a gateway, to which things happen.
class ModuleAlone final : private Stage {
  public:
    /// It outlives this.
    explicit ModuleAlone(MidiModule& module) : module_(module), runner_(nothing_, names_, *this) {}

    /// From now on; with the next observe().
    void also(Actions actions, Time now) { runner_.also(std::move(actions), now); }
    /// From time to time: does what is due.
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
